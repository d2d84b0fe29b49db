// Times of exact derivatives per interval: the tape, a replay number by number, ADOL-C, and the assembled program.
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/benchmarks.hpp"
#include "bench/speed/measurements.hpp"
#include "bench/speed/start_benchmarks.hpp"
#include "bench/speed/summary.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// What a run without flags leaves out, so that it takes a minute: several stages, and the chains of links.
constexpr const char* default_filter = "--benchmark_filter=-gauss_[2-9]|link_chain";

void run() {
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

  CollectingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  if (!reporter.measurements().empty()) fmt::print("{}", summary(reporter.measurements(), problems));
  benchmark::Shutdown();
}

}  // namespace

}  // namespace dmocbench::speed

int main(int argc, char** argv) {
  using dmocbench::speed::initialize, dmocbench::speed::run, dmocbench::speed::default_filter;
  const std::span<char* const> arguments(argv, static_cast<std::size_t>(argc));
  try {
    if (!initialize(arguments.front(), arguments.subspan(1), {default_filter})) return 2;
    run();
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "speed: {}\n", error.what());
    return 1;
  }
}
