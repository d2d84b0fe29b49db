// Whole solves, from the problem's own guess: the interior-point method by intervals against Ipopt, with the same
// derivatives, on one thread and on two.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/solve_benchmark.hpp"
#include "bench/speed/solve_name.hpp"
#include "bench/speed/solve_reporter.hpp"
#include "bench/speed/solve_table.hpp"
#include "bench/speed/start_benchmarks.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// What a run without flags does, so that it takes seconds; long grids and the library are left out.
constexpr const char* default_filter = "^[^/]*/[^/]*/(64|1024)/";

void add(const SolveName& name) {
  const auto subject = std::make_shared<SolveBenchmark>(name);
  benchmark::RegisterBenchmark(name.text().c_str(), [subject](benchmark::State& state) { subject->run(state); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

/// One grid by both solvers, and where it is long by two threads.
void add_solves(SolveName name) {
  constexpr int most_intervals_of_ipopt = 262144;  // beyond it no solve ends within its minute
  constexpr int fewest_intervals_of_two = 16384;   // the next shorter grid is a single part of the work
  name.solver = "interior_point";
  add(name);
  if (name.intervals >= fewest_intervals_of_two) {
    SolveName by_two = name;
    by_two.threads = 2;
    add(by_two);
  }
  name.solver = "ipopt";
  if (name.intervals <= most_intervals_of_ipopt) add(name);
}

void register_solves() {
  const std::vector<std::string> methods{"dmoc", "hamiltonian", "tangent"};
  const std::vector<std::string> papers = paper_problem_names();
  for (const std::string& problem : problems_on_all_grids()) {
    for (const std::string& method : methods) {
      for (const int intervals : {64, 1024, 16384, 65536, 262144, 1048576}) {
        add_solves(
            {.is_of_library = false, .problem = problem, .method = method, .intervals = intervals, .solver = {}});
      }
    }
  }
  for (const std::string& problem : problem_names()) {
    if (std::find(papers.begin(), papers.end(), problem) != papers.end()) continue;  // these are there already
    for (const std::string& method : methods) {
      add_solves({.is_of_library = true, .problem = problem, .method = method, .intervals = 1024, .solver = {}});
    }
  }
}

void run(const std::filesystem::path& csv) {
  register_solves();
  SolveReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  if (!reporter.solves().empty()) {
    fmt::print("{}", solve_summary(reporter.solves()));
    write_tables(csv, {{"", solve_rows(reporter.solves())},
                       {"_ratios", solve_ratios(reporter.solves())},
                       {"_exponents", solve_exponents(reporter.solves())}});
  }
  benchmark::Shutdown();
}

}  // namespace

}  // namespace dmocbench::speed

int main(int argc, char** argv) {
  using namespace dmocbench::speed;  // NOLINT(google-build-using-namespace): the program's own
  return start({argv, static_cast<std::size_t>(argc)},
               {.name = "solves",
                .description = "Times of whole solves by interior_point and by Ipopt.",
                .csv = "write FILE, a row per benchmark, FILE_ratios and FILE_exponents",
                .default_filter = default_filter},
               run);
}
