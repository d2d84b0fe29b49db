// Times of exact derivatives per interval: the tape, a replay number by number, ADOL-C, and the assembled program.
#include <exception>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/benchmarks.hpp"
#include "bench/speed/measurements.hpp"
#include "bench/speed/summary.hpp"

namespace {

/// Google Benchmark's flags, ours first so that the user's win. Interleaving spreads a disturbance over all benchmarks:
/// ratios within a run suffer less from a shared machine than times do.
void initialize(int argc, char** argv) {
  std::vector<std::string> arguments{argv[0], "--benchmark_repetitions=5", "--benchmark_min_time=0.05",
                                     "--benchmark_enable_random_interleaving=true"};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  static std::vector<std::string> kept;  // the library keeps a pointer to the program's name
  kept = std::move(arguments);
  std::vector<char*> pointers;
  for (std::string& argument : kept) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  int count = static_cast<int>(kept.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) throw std::invalid_argument("see above");
}

void run(int argc, char** argv) {
  using namespace dmocbench::speed;  // NOLINT(google-build-using-namespace)
  initialize(argc, argv);
  const std::vector<std::string> problems{"orbital_transfer", "two_link_manipulator"};
  Subjects subjects;
  for (const std::string& problem : problems) subjects.push_back(std::make_unique<Subject>(problem));
  register_tape_benchmarks(subjects);
  register_program_benchmarks(subjects);
  register_replay_benchmarks(subjects);
  register_adolc_benchmarks(subjects);

  CollectingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  if (!reporter.measurements().empty()) fmt::print("{}", summary(reporter.measurements(), problems));
  benchmark::Shutdown();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc, argv);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "speed: {}\n", error.what());
    return 1;
  }
}
