// Programs that are solved again and again: a `PreparedSolve` against `Solver::solve`, turn by turn.
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/benchmark_program.hpp"
#include "bench/speed/guessed_program.hpp"
#include "methods/error.hpp"
#include "methods/numerics/median.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/solvers/prepared_solve.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/moved_to_ends.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

struct RepeatedSolve {
  std::string problem;
  std::string method;
  int intervals = 0;
  bool is_warm = false;
};

constexpr double microseconds = 1e6;  // of a second

/// A program with a start. A cold one is the problem's guess; a warm one is the motion, with its multipliers, that is
/// optimal for an end state whose nonzero entries are smaller by one percent, moved to the ends.
struct StartedProgram {
  GuessedProgram made;
  Eigen::VectorXd start;
  Eigen::VectorXd multipliers;

  explicit StartedProgram(const RepeatedSolve& solve)
      : made(make_problem(solve.problem), solve.method, solve.intervals), start(made.start) {
    if (!solve.is_warm) return;
    Transcription& program = *made.program;
    BoundaryState end = made.problem->final_state();
    end.q *= 0.99;
    end.v *= 0.99;
    program.set_final_state(end);
    const Solution neighbour = make_solver("interior_point")->solve(program, made.start);
    if (!is_solved(neighbour.status)) throw Error("the neighbour of the warm start is not solved");
    multipliers = neighbour.multipliers;
    const Motion motion = smooth_motion(read_trajectory(program, neighbour.primal, multipliers));
    program.set_final_state(made.problem->final_state());
    start = sample(program, moved_to_ends(motion, program.bounds()));
  }
};

/// The time that `interior_point` takes for an interval in an iteration where there are many: N = 1024, cold.
double seconds_per_interval(const RepeatedSolve& solve) {
  constexpr int many = 1024;
  constexpr int turns = 15;
  static std::map<std::pair<std::string, std::string>, double> known;
  const auto [entry, is_new] = known.try_emplace({solve.problem, solve.method}, 0.0);
  if (!is_new) return entry->second;
  const StartedProgram long_one({solve.problem, solve.method, many, false});
  PreparedSolve prepared(*long_one.made.program);
  std::vector<double> seconds;
  seconds.reserve(turns);
  for (int i = 0; i < turns; ++i) seconds.push_back(prepared.solve(long_one.start).seconds);
  entry->second = median(seconds) / many / prepared.solution().major_iterations.value_or(1);
  return entry->second;
}

template <class Solve>
double seconds_of(const Solve& solve) {
  const Clock::time_point begin = Clock::now();
  solve();
  return seconds_since(begin);
}

/// Every turn solves once by either way, each with all that it does, judging the answer among it. The manual time is
/// the prepared solve's.
void run(benchmark::State& state, const RepeatedSolve& solve) {
  const StartedProgram given(solve);
  const auto solver = make_solver("interior_point");
  PreparedSolve prepared(*given.made.program);
  PreparedSolve by_residuals(*given.made.program, "interior_point", {}, PreparedSolve::Judgement::residuals_only);
  static_cast<void>(prepared.solve(given.start, given.multipliers));
  static_cast<void>(by_residuals.solve(given.start, given.multipliers));
  Solution plain;
  std::vector<double> plain_seconds;
  std::vector<double> prepared_seconds;
  std::vector<double> residual_seconds;
  for ([[maybe_unused]] auto turn : state) {
    plain_seconds.push_back(
        seconds_of([&] { plain = solver->solve(*given.made.program, given.start, given.multipliers); }));
    prepared_seconds.push_back(seconds_of([&] { static_cast<void>(prepared.solve(given.start, given.multipliers)); }));
    residual_seconds.push_back(
        seconds_of([&] { static_cast<void>(by_residuals.solve(given.start, given.multipliers)); }));
    state.SetIterationTime(prepared_seconds.back());
  }
  const Solution& solution = prepared.solution();
  if (solution.primal != plain.primal) state.SkipWithError("both ways differ");
  const double iterations = std::max(1, solution.major_iterations.value_or(0));
  const double seconds = median(prepared_seconds);
  state.SetLabel(fmt::format("problem={} method={} intervals={} start={}", solve.problem, solve.method, solve.intervals,
                             solve.is_warm ? "warm" : "cold"));
  state.counters["iterations"] = iterations;
  state.counters["solved"] = is_solved(solution.status) ? 1.0 : 0.0;
  state.counters["plain_microseconds"] = microseconds * median(plain_seconds);
  state.counters["prepared_microseconds"] = microseconds * seconds;
  state.counters["residuals_microseconds"] = microseconds * median(residual_seconds);
  state.counters["plain_over_prepared"] = median(plain_seconds) / seconds;
  state.counters["over_long_grid"] = seconds / (iterations * solve.intervals * seconds_per_interval(solve));
}

/// PROBLEM/METHOD/INTERVALS/cold or warm
void register_solves() {
  for (const std::string& problem : paper_problem_names()) {
    for (const std::string& method : paper_families()) {
      for (const int intervals : {16, 64}) {
        for (const bool is_warm : {false, true}) {
          const RepeatedSolve solve{problem, method, intervals, is_warm};
          const std::string name = fmt::format("{}/{}/{}/{}", problem, method, intervals, is_warm ? "warm" : "cold");
          add_benchmark(name, benchmark::kMicrosecond, [solve](benchmark::State& state) { run(state, solve); });
        }
      }
    }
  }
}

}  // namespace

int run_prepared(int argc, char** argv) {
  const BenchmarkProgram program{.name = "prepared",
                                 .description = "Programs that are solved again: prepared solves against plain ones.",
                                 .default_filter = "/dmoc/",
                                 .register_benchmarks = register_solves};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_prepared(argc, argv); }
