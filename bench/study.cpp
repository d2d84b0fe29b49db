// Everything about one problem: motion, orders, invariants, minima, figures, and a report.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/run/command_line.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/options.hpp"
#include "bench/run/problem_libraries.hpp"
#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"

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

/// The script that draws figures: installed next to the program, else the one of the sources.
std::string drawer() {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path installed = self.parent_path() / "dmocbench-figures";
  return std::filesystem::exists(installed) ? installed.string() : DMOCBENCH_SOURCE_DIR "/plots/figures";
}

/// The words that start a program of the suite: the one of this name next to this program, or this one if it contains
/// all of them.
std::vector<std::string> start_of_program(const std::string& name) {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  if (self.filename() != "study") return {self.string(), name};
  const std::filesystem::path program = self.parent_path() / name;
  if (::access(program.c_str(), X_OK) != 0)
    throw Error(fmt::format("there is no program {}; build it", program.string()));
  return {program.string()};
}

/// Becomes that program. Throws `Error` if it cannot be run.
[[noreturn]] void run_in_place(const std::vector<std::string>& command_line) {
  std::vector<char*> words;
  std::vector<std::string> copies = command_line;
  words.reserve(copies.size() + 1);
  for (std::string& word : copies) words.push_back(word.data());
  words.push_back(nullptr);
  std::fflush(nullptr);
  ::execv(words.front(), words.data());
  throw Error(
      fmt::format("cannot run {}: {}", command_line.front(), std::strerror(errno)));  // NOLINT(concurrency-mt-unsafe)
}

/// Runs a command and returns its exit code, 128 and the signal's number if a signal ended it.
int run_and_wait(const std::vector<std::string>& words) {
  fmt::print("+ {}\n", fmt::join(words, " "));
  std::fflush(nullptr);
  const ::pid_t child = ::fork();
  if (child < 0) throw Error("cannot create a process");
  if (child == 0) {
    try {
      run_in_place(words);
    } catch (const Error& error) {
      std::fputs((std::string("study: ") + error.what() + "\n").c_str(), stderr);
      ::_exit(2);
    }
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  constexpr int base_of_signals = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : base_of_signals + WTERMSIG(status);
}

/// The grid for local minima: fine enough for a motion, cheap enough for many starts.
long long second_finest(const Study& study) {
  std::vector<long long> grids = parse_intervals("--intervals", study.intervals);
  std::ranges::sort(grids);
  return grids[grids.size() < 2 ? 0 : grids.size() - 2];
}

/// The steps by name, each a command.
std::vector<std::pair<std::string, std::vector<std::string>>> commands_of(const Study& study) {
  const std::string out = study.out.string();
  const auto experiment = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> words = start_of_program(name);
    words.insert(words.end(), {"--problem", study.problem, "--out", out});
    for (const std::string& library : study.libraries) words.insert(words.end(), {"--library", library});
    for (const std::string& setting : study.settings) words.insert(words.end(), {"--set", setting});
    if (name != "invariants")  // which compares tableaus
      words.insert(words.end(), {"--tableau", study.tableau, "--stages", std::to_string(study.stages)});
    words.insert(words.end(), options.begin(), options.end());
    return std::pair(name, words);
  };
  std::vector<std::string> report = start_of_program("report");
  report.insert(report.end(), {"--from", out});
  for (const std::string& library : study.libraries) report.insert(report.end(), {"--library", library});
  return {experiment("solve", {"--method", "dmoc", "--start", "common", "--name", "motion_" + study.problem}),
          experiment("convergence", {"--intervals", study.intervals, "--solver", "auto"}),
          experiment("invariants", {}),
          experiment("local_minima",
                     {"--starts", std::to_string(study.starts), "--intervals", std::to_string(second_finest(study))}),
          {"figures", {drawer(), out}},
          {"report", report}};
}

int run_all(CommandLine& line) {
  Study study;
  line.group(group_of_problem);
  line.option("--problem", study.problem, "the problem");
  line.option("--set", study.settings, "parameter=value of the problem; may be repeated");
  add_library_option(line, study.libraries);
  line.group("Experiments");
  line.option("--tableau", study.tableau, "the family of Butcher tableaus of all experiments");
  line.number("--stages", study.stages, 1, 4, "its number of stages");
  line.option("--intervals", study.intervals, "grids of convergence; local_minima uses the second finest");
  line.number("--starts", study.starts, 1, 100000, "starts of local_minima per method");
  line.group(group_of_output);
  line.option("--out", study.out, "folder for the results; default: study_PROBLEM");
  line.example("--problem cart_pole");
  line.exit_code_1("a step has failed; the others have run");
  line.parse();
  if (study.problem.empty()) throw Error("name a problem: study --problem cart_pole; list shows all problems");
  if (study.out.empty()) study.out = "study_" + study.problem;
  listen_for_interrupt();
  std::vector<std::string> failed;
  for (const auto& [step, command] : commands_of(study)) {
    const int code = run_and_wait(command);
    throw_if_interrupted();
    if (code == 2 && step == "solve") return code;  // what it rejects, such as an unknown problem, all steps reject
    if (code != 0) failed.push_back(step);
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
