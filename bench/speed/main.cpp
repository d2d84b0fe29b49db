// Times of exact derivatives per interval: the tape, the assembled program, formulas written by hand, a replay number
// by number, ADOL-C; and what the machine can do at most.
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/experiment/result_file.hpp"
#include "bench/speed/benchmarks.hpp"
#include "bench/speed/interval_table.hpp"
#include "bench/speed/machine.hpp"
#include "bench/speed/measurements.hpp"
#include "bench/speed/start_benchmarks.hpp"
#include "bench/speed/summary.hpp"
#include "methods/error.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// What a run without flags leaves out, so that it takes a minute: several stages, and the chains of links.
constexpr const char* default_filter = "--benchmark_filter=-gauss_[2-9]|link_chain";

/// Finds out before anything is timed whether the tables can be written. Throws `Error` if not.
void prepare(const std::filesystem::path& file) {
  if (file.empty()) return;
  prepare_folder(file.has_parent_path() ? file.parent_path() : ".");
  if (std::filesystem::is_directory(file)) {
    throw Error(fmt::format("cannot write {}: it is a folder; name a file in it", file.string()));
  }
}

/// FILE.csv and FILE_machine.csv.
void write_tables(const std::filesystem::path& file, const Table& intervals, const Table& machine) {
  write_file(file, intervals.csv());
  std::filesystem::path beside = file;
  beside.replace_filename(file.stem().string() + "_machine" + file.extension().string());
  write_file(beside, machine.csv());
}

void run(const std::filesystem::path& csv) {
  const std::vector<std::string> problems = paper_problem_names();
  Subjects subjects;
  for (const std::string& problem : problems) {
    subjects.push_back(std::make_unique<Subject>(Formulas{.problem = problem}));
  }
  register_tape_benchmarks(subjects);
  register_program_benchmarks();
  register_hand_benchmarks(subjects);
  register_replay_benchmarks(subjects);
  register_adolc_benchmarks(subjects);
  register_machine_benchmarks();

  CollectingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  if (!reporter.measurements().empty()) {
    const Table intervals = interval_table(reporter.measurements());
    fmt::print("{}{}", roofline(intervals), summary(reporter.measurements(), problems));
    if (!csv.empty()) write_tables(csv, intervals, machine_table(reporter.measurements()));
  }
  benchmark::Shutdown();
}

int start(int argc, char** argv) {
  CLI::App app("Times of exact derivatives per interval. All flags of Google Benchmark hold as well:", "speed");
  std::filesystem::path csv;
  app.add_option("--csv", csv, "write FILE, a row per benchmark, and FILE_machine, what the machine can do")
      ->option_text("FILE");
  app.allow_extras();
  std::vector<std::string> flags;
  try {
    app.parse(argc, argv);
    flags = app.remaining();
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}\n", app.help());
    flags = {"--help"};  // the library adds its own and ends the program
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "speed: {}; --help lists the flags\n", error.what());
    return 2;
  }
  std::vector<char*> pointers;
  pointers.reserve(flags.size());
  for (std::string& flag : flags) pointers.push_back(flag.data());
  if (!initialize(*argv, pointers, {default_filter})) return 2;
  try {
    prepare(csv);
  } catch (const Error& error) {
    fmt::print(stderr, "speed: {}\n", error.what());
    return 2;
  }
  run(csv);
  return 0;
}

}  // namespace

}  // namespace dmocbench::speed

int main(int argc, char** argv) {
  try {
    return dmocbench::speed::start(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "speed: {}\n", error.what());
    return 1;
  }
}
