// Everything about one problem: motion, orders, invariants, minima, figures, and a report.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/programs.hpp"
#include "bench/run/build.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/options.hpp"
#include "bench/run/problem_libraries.hpp"
#include "methods/error.hpp"

namespace dmocbench::study_program {

/// The choices of a user.
struct Study {
  std::string problem;
  std::vector<std::string> settings;
  std::string tableau = "gauss";
  long long stages = 1;
  std::vector<std::string> libraries;
  std::string intervals = "16:256";
  long long starts = 20;
  std::filesystem::path out;
};

/// The script that draws figures: in an installation next to the program, in a wheel below the Python module, with a
/// module of an installation in the prefix's bin; else the one of the sources.
std::string drawer() {
  const std::filesystem::path folder = own_file().parent_path();
  for (const char* place : {"dmocbench-figures", "plots/figures", "../../../../bin/dmocbench-figures"}) {
    if (std::filesystem::exists(folder / place)) return (folder / place).lexically_normal().string();
  }
  return DMOCBENCH_SOURCE_DIR "/plots/figures";
}

/// For functions of C that take an array of words.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Runs another executable and returns its exit code, 128 and the signal's number if a signal ended it.
int run_and_wait(std::vector<std::string> words) {
  ::pid_t child = 0;
  const int failure =
      ::posix_spawn(&child, words.front().c_str(), nullptr, nullptr, pointers_to(words).data(), environ);
  if (failure != 0) throw Error("cannot run {}: {}", words.front(), std::generic_category().message(failure));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  constexpr int base_of_signals = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : base_of_signals + WTERMSIG(status);
}

/// One step: a program of the suite, or the drawer.
struct Step {
  std::string name;
  std::vector<std::string> words;  ///< a command line as a user would type it
};

/// Runs a step and returns its exit code. Programs of the suite run in this process, where problems of Python are
/// known. Throws `Error` if `solve` rejects its options: all other steps would.
int run_step(Step step) {
  fmt::print("+ {}\n", fmt::join(step.words, " "));
  std::fflush(nullptr);
  const auto program = std::ranges::find(programs(), step.name, &Program::name);
  if (program == programs().end()) return run_and_wait(step.words);
  std::string complaint;
  const ComplaintScope scope(&complaint);
  const int code = program->run(static_cast<int>(step.words.size()), pointers_to(step.words).data());
  if (code == 2 && step.name == "solve") throw Error(complaint);
  if (!complaint.empty()) fmt::print(stderr, "{}: {}\n", step.name, complaint);
  return code;
}

/// The grid for local minima: fine enough for a motion, cheap enough for many starts.
long long second_finest(const Study& study) {
  std::vector<long long> grids = parse_intervals("--intervals", study.intervals);
  std::ranges::sort(grids);
  return grids[grids.size() < 2 ? 0 : grids.size() - 2];
}

/// The steps. `call`: the words by which `study` itself was called, as "dmocbench study".
std::vector<Step> steps_of(const Study& study, const std::string& call) {
  const std::string out = study.out.string();
  const auto program = [&](const std::string& name, const std::vector<std::string>& options) {
    Step step{name, {call.substr(0, call.rfind("study")) + name}};
    step.words.insert(step.words.end(), options.begin(), options.end());
    for (const std::string& library : study.libraries) step.words.insert(step.words.end(), {"--library", library});
    return step;
  };
  const auto experiment = [&](const std::string& name, const std::vector<std::string>& options) {
    Step step = program(name, {"--problem", study.problem, "--out", out});
    for (const std::string& setting : study.settings) step.words.insert(step.words.end(), {"--set", setting});
    if (name != "invariants")  // which compares tableaus
      step.words.insert(step.words.end(), {"--tableau", study.tableau, "--stages", std::to_string(study.stages)});
    step.words.insert(step.words.end(), options.begin(), options.end());
    return step;
  };
  return {experiment("solve", {"--method", "dmoc", "--start", "common", "--name", "motion_" + study.problem}),
          experiment("convergence", {"--intervals", study.intervals}),
          experiment("invariants", {}),
          experiment("local_minima",
                     {"--starts", std::to_string(study.starts), "--intervals", std::to_string(second_finest(study))}),
          {"figures", {drawer(), out}},
          program("report", {"--from", out})};
}

int run_all(CommandLine& line) {
  Study study;
  line.group(group_of_problem);
  line.option("--problem", study.problem, "the problem");
  line.option("--set", study.settings, "set a parameter of the problem as PARAMETER=VALUE; may be repeated");
  add_library_option(line, study.libraries);
  line.group("Experiments");
  line.option("--tableau", study.tableau, "family of Butcher tableaus; invariants compares all families");
  line.number("--stages", study.stages, 1, 4, "number of stages of the tableau");
  line.option("--intervals", study.intervals, "grids of convergence; local_minima uses the second finest grid");
  line.number("--starts", study.starts, 1, 100000, "number of starts per method in local_minima");
  line.group(group_of_output);
  line.option("--out", study.out, "folder for the results; default: study_PROBLEM");
  line.example("--problem cart_pole");
  line.exit_code_1("a step failed; the other steps were run");
  const std::string call = line.parse().front();
  if (study.problem.empty()) throw Error("name a problem, such as study --problem cart_pole; list prints all problems");
  if (study.out.empty()) study.out = "study_" + study.problem;
  listen_for_interrupt();
  std::vector<std::string> failed;
  for (const Step& step : steps_of(study, call)) {
    const int code = run_step(step);
    throw_if_interrupted();
    if (code != 0) failed.push_back(step.name);
  }
  const std::filesystem::path report = study.out / "report.html";
  fmt::print("study: {}: {}\n", failed.empty() ? "all steps done" : fmt::format("failed: {}", fmt::join(failed, ", ")),
             std::filesystem::exists(report) ? report.string() : "no report");
  return failed.empty() ? 0 : 1;
}

int run(int argc, char** argv) {
  return run_program(
      "study",
      "Runs solve, convergence, invariants and local_minima on one problem, draws the figures and writes the "
      "report.",
      argc, argv, run_all);
}

}  // namespace dmocbench::study_program
