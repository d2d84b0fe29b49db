// Whole solves, from the problem's own guess: the interior-point method by intervals against Ipopt, with the same
// derivatives, on one thread and on two.
#include <algorithm>
#include <cstddef>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "bench/speed/benchmark_program.hpp"
#include "bench/speed/guessed_program.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "problems/two_link_manipulator.hpp"

namespace dmocbench::speed {

namespace {

/// The paper's two-link manipulator with both torques between -16 and 16 N m, which is enough for the swing-up but less
/// than it takes without bounds: the least cost rises from 80.38 to 80.65.
class TwoLinkManipulatorBounded final : public TwoLinkManipulator {
 public:
  static constexpr const char* own_name = "two_link_manipulator_bounded";

  [[nodiscard]] std::string name() const override { return own_name; }
  [[nodiscard]] ProblemBounds bounds() const override {
    constexpr double largest_torque = 16.0;
    ProblemBounds bounds = TwoLinkManipulator::bounds();
    bounds.u = Bounds::all(2, -largest_torque, largest_torque);
    return bounds;
  }
};

/// A line "NAME:   1234 kB" of the kernel's report on this process, in bytes; empty if the system does not report it.
std::optional<double> bytes_of(const std::string& name) {
  std::ifstream report("/proc/self/status");
  for (std::string word; report >> word;) {
    double kilobytes = 0.0;
    if (word == name && report >> kilobytes) return 1024.0 * kilobytes;
  }
  return std::nullopt;
}

/// A solve that is timed.
struct SolveCase {
  std::string problem;
  std::string method;
  int intervals = 0;
  std::string solver = "interior_point";
  int threads = 1;
};

GuessedProgram program_of(const SolveCase& solve) {
  const std::shared_ptr<const Problem> problem = solve.problem == TwoLinkManipulatorBounded::own_name
                                                     ? std::make_shared<TwoLinkManipulatorBounded>()
                                                     : std::shared_ptr<const Problem>(make_problem(solve.problem));
  return {problem, solve.method, solve.intervals};
}

std::unique_ptr<Solver> make_solver_of(const SolveCase& solve) {
  SolverOptions options;
  options.most_seconds = 60.0;  // beyond it a solve counts as failed
  return make_solver(solve.solver, options);
}

/// The peak memory of this process while a program was made and solved, less the memory before; empty if the system
/// does not report it.
///
/// Memory that others freed before is handed back to the system first, so that it does not hide memory taken again;
/// pages that the heap cannot hand back do hide some hundred kilobytes. The solve is one of its own, which is not
/// timed: handing back memory makes the next solve slower.
std::optional<double> peak_bytes(const SolveCase& solve) {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  std::ofstream references("/proc/self/clear_refs");
  references << "5" << std::flush;  // the peak becomes the memory in use now, proc(5)
  const auto before = references.good() ? bytes_of("VmRSS:") : std::nullopt;
  const GuessedProgram made = program_of(solve);
  (void)make_solver_of(solve)->solve(*made.program, made.start);
  const auto peak = bytes_of("VmHWM:");
  return before && peak ? std::optional(std::max(0.0, *peak - *before)) : std::nullopt;
}

/// Every turn of the timed loop is one solve from the guess. A solver's set-up before its first iteration is part of
/// it; the trace, its derivatives and judging the answer are not. Sets the counters of the solve.
void measure_solves(benchmark::State& state, const Solver& solver, const GuessedProgram& made) {
  constexpr double nanoseconds = 1e9;  // of a second
  Solution solution;
  double seconds = 0.0;
  double evaluation_seconds = 0.0;
  for ([[maybe_unused]] auto turn : state) {
    solution = solver.solve(*made.program, made.start);
    state.SetIterationTime(solution.seconds);
    seconds += solution.seconds;
    evaluation_seconds += solution.evaluation_seconds;
  }
  const double iterations = solution.major_iterations.value_or(0);
  const auto intervals = static_cast<double>(made.program->interval_structure()->intervals);
  const double interval_turns = static_cast<double>(state.iterations()) * intervals;
  state.counters["major_iterations"] = iterations;
  if (solution.linear_systems) state.counters["linear_systems"] = *solution.linear_systems;
  state.counters["objective"] = solution.objective;
  state.counters["solved"] = is_solved(solution.status) ? 1.0 : 0.0;
  state.counters["evaluation_share"] = evaluation_seconds / seconds;
  state.counters["ns_per_interval_iteration"] = nanoseconds * seconds / interval_turns / std::max(1.0, iterations);
  state.counters["setup_seconds"] = made.setup_seconds;
}

/// Every repetition makes the program again. So making it is measured as often as solving it, the place of its arrays
/// is part of the noise of the repetitions, and no program of a million intervals, a gigabyte, waits for its turn.
void run(benchmark::State& state, const SolveCase& solve, std::optional<double> bytes) {
  measure_solves(state, *make_solver_of(solve), program_of(solve));
  if (bytes) state.counters["bytes_per_interval"] = *bytes / solve.intervals;
  state.SetLabel(fmt::format("problem={} method={} intervals={} solver={} threads={}", solve.problem, solve.method,
                             solve.intervals, solve.solver, solve.threads));
}

/// [library/]PROBLEM/METHOD/INTERVALS/SOLVER[/threads_COUNT]; one thread is not named.
void add(const std::string& part, const SolveCase& solve) {
  const std::string name =
      fmt::format("{}{}/{}/{}/{}{}", part, solve.problem, solve.method, solve.intervals, solve.solver,
                  solve.threads == 1 ? "" : fmt::format("/threads_{}", solve.threads));
  const auto bytes = std::make_shared<std::optional<std::optional<double>>>();  // not known before the first repetition
  add_benchmark(name, benchmark::kMillisecond, [solve, bytes](benchmark::State& state) {
    set_thread_count(static_cast<std::size_t>(solve.threads));
    if (!*bytes) *bytes = peak_bytes(solve);
    run(state, solve, **bytes);
  });
}

/// Adds the solves of one grid: by interior_point on one thread and, where the grid is long, on two; by Ipopt.
void add_grid(const std::string& part, SolveCase solve) {
  constexpr int most_intervals_of_ipopt = 262144;  // beyond it no solve ends within its minute
  constexpr int fewest_intervals_of_two = 16384;   // the next shorter grid is a single part of the work
  add(part, solve);
  solve.threads = 2;
  if (solve.intervals >= fewest_intervals_of_two) add(part, solve);
  solve.threads = 1;
  solve.solver = "ipopt";
  if (solve.intervals <= most_intervals_of_ipopt) add(part, solve);
}

/// Adds the paper's two problems and a third, which has inequalities, on every grid, and each other problem of the
/// library on one grid.
void register_solves() {
  const std::vector<std::string> papers = paper_problem_names();
  std::vector<std::string> on_all_grids = papers;
  on_all_grids.emplace_back(TwoLinkManipulatorBounded::own_name);
  for (const std::string& problem : on_all_grids) {
    for (const std::string& method : paper_families()) {
      for (const int intervals : {64, 1024, 16384, 65536, 262144, 1048576}) add_grid("", {problem, method, intervals});
    }
  }
  for (const std::string& problem : problem_names()) {
    if (std::ranges::find(papers, problem) != papers.end()) continue;
    for (const std::string& method : paper_families()) add_grid("library/", {problem, method, 1024});
  }
}

}  // namespace

int run_solves(int argc, char** argv) {
  // Without flags it takes seconds: long grids and the library are left out.
  const BenchmarkProgram program{.name = "solves",
                                 .description = "Measures times of whole solves with interior_point and with Ipopt.",
                                 .default_filter = "^[^/]*/[^/]*/(64|1024)/",
                                 .register_benchmarks = register_solves};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_solves(argc, argv); }
