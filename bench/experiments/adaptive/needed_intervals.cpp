#include "bench/experiments/adaptive/needed_intervals.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/run/solve_case.hpp"
#include "methods/adaptive/adaptive_solve.hpp"
#include "methods/numerics/quantile.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

constexpr long long most_uniform = 6000;

/// A solve on a uniform grid.
struct UniformSolve {
  Status status = Status::not_run;
  long long intervals = 0;
  std::size_t variables = 0;
  double error = 0.0;
};

UniformSolve solve_uniform(const CertifiedProblem& certified, const Scheme& scheme, long long intervals,
                           const Solver& solver) {
  const auto program = certified.transcribe(scheme, intervals);
  const Solution solution =
      solve_from(*program, sample(*program, smooth_motion(certified.motion())), certified.motion(), solver);
  UniformSolve result{.status = solution.status, .intervals = intervals, .variables = program->variable_count()};
  if (!is_solved(solution.status)) return result;
  result.error = true_error(certified, read_trajectory(*program, solution.primal, solution.multipliers)).relative;
  return result;
}

/// The number of intervals at which the error is the accuracy, by the order.
long long predicted(const UniformSolve& from, double accuracy, int order) {
  constexpr double most_growth = 8.0;
  const double growth = std::clamp(std::pow(from.error / accuracy, 1.0 / order), 1.0 / most_growth, most_growth);
  return std::llround(static_cast<double>(from.intervals) * growth);
}

}  // namespace

std::optional<double> NeededGrid::variables_at_accuracy() const {
  if (!variables || !true_error) return std::nullopt;
  return static_cast<double>(*variables) * std::pow(*true_error / accuracy, 1.0 / order);
}

NeededGrid needed_adapted(const CertifiedProblem& certified, const Scheme& scheme, double accuracy, const Motion& start,
                          int rounds, const std::string& solver, const SolverOptions& options,
                          std::vector<StepOfGrid>& steps) {
  AdaptiveOptions adaptive;
  adaptive.accuracy = accuracy;
  adaptive.solver = solver;
  adaptive.solver_options = options;
  const AdaptiveTask task{.problem = &certified.problem(),
                          .method = scheme.method,
                          .tableau = scheme.tableau,
                          .stages = static_cast<int>(scheme.stages),
                          .first = Grid::uniform(32),
                          .start = start};
  NeededGrid found{.scheme = scheme, .grid = "adapted", .accuracy = accuracy};
  found.order = make_tableau(scheme.tableau, task.stages).order;
  const AdaptiveAnswer answer = solve_adaptively(task, adaptive);
  stop_if_requested();
  found.grids = answer.grids.size();
  found.status = name_of(answer.solution.status);
  if (answer.outcome != AdaptiveOutcome::reached) {
    if (is_solved(answer.solution.status)) found.status = answer.message;
    return found;
  }
  const GridAttempt& last = answer.grids.back();
  found.intervals = last.intervals;
  found.variables = answer.program->variable_count();
  found.true_error = true_error(certified, answer.trajectory).relative;
  found.estimated_error = answer.estimate.relative;
  found.largest_step = last.largest_step;
  found.smallest_step = last.smallest_step;
  for (int round = 0; round < rounds; ++round) {
    const auto begin = Clock::now();
    static_cast<void>(solve_adaptively(task, adaptive));
    found.rounds.push_back(seconds_since(begin));
  }
  if (scheme.method != "dmoc") return found;  // figures show one family
  const Trajectory& motion = answer.trajectory;
  const double largest = motion.q.col(0).cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < motion.intervals(); ++k) {
    steps.push_back({scheme, motion.node_times[k], motion.step(k), motion.q(k, 0) / largest});
  }
  return found;
}

NeededGrid needed_uniform(const CertifiedProblem& certified, const Scheme& scheme, double accuracy,
                          const std::string& solver_name, const SolverOptions& options) {
  constexpr int most_solves = 14;
  constexpr double sharp = 1.02;
  SolverOptions exact = options;
  exact.tolerance = std::min(options.tolerance, 1e-12);
  const auto solver = make_solver(solver_name, exact);
  NeededGrid found{.scheme = scheme, .grid = "uniform", .accuracy = accuracy};
  found.order = make_tableau(scheme.tableau, static_cast<int>(scheme.stages)).order;
  UniformSolve best;
  long long too_few = 0;
  long long next = 64;
  for (int number = 0; number < most_solves; ++number) {
    if (next > most_uniform) {
      found.status = fmt::format("more than {} intervals", most_uniform);
      return found;
    }
    const UniformSolve solve = solve_uniform(certified, scheme, next, *solver);
    found.status = name_of(solve.status);
    if (!is_solved(solve.status)) return found;
    const bool reaches = solve.error <= accuracy;
    if (reaches && (best.intervals == 0 || solve.intervals < best.intervals)) best = solve;
    if (!reaches) too_few = std::max(too_few, solve.intervals);
    if (best.intervals > 0 && static_cast<double>(best.intervals) <= sharp * static_cast<double>(too_few + 1)) break;
    next = predicted(solve, accuracy, found.order) + (reaches ? 0 : 1);
    next = std::max(next, too_few + 1);
    if (best.intervals > 0 && next >= best.intervals) next = (too_few + best.intervals) / 2;
  }
  if (best.intervals == 0) {
    found.status = "not found";
    return found;
  }
  found.intervals = best.intervals;
  found.variables = best.variables;
  found.true_error = best.error;
  found.largest_step = certified.problem().horizon() / static_cast<double>(best.intervals);
  found.smallest_step = found.largest_step;
  return found;
}

Columns<NeededGrid> needed_columns() {
  using N = NeededGrid;
  return scheme_columns<N>() +
         Columns<N>{
             {"grid", "", "kind of grid: uniform or adapted", &N::grid, in_key},
             {"accuracy", "", "requested relative error of q, p and cost", &N::accuracy},
             {"status", "", "status of the last solve, or the reason for the missing grid", &N::status},
             {"intervals", "", "number of intervals N", &N::intervals},
             {"variables", "", "number of variables of the program", &N::variables},
             {"variables_at_accuracy", "", "number of variables times (true error / accuracy)^(1/order)",
              &N::variables_at_accuracy},
             {"true_error", "", "relative error with respect to the certified optimum", &N::true_error},
             {"estimated_error", "", "estimated relative error", &N::estimated_error},
             {"largest_step", "", "h", &N::largest_step},
             {"smallest_step", "", "h", &N::smallest_step},
             {"grids", "", "number of grids, including the last one", &N::grids},
             {"seconds", "s", "time of the whole refinement with interior_point, median over the rounds",
              [](const N& found) { return found.rounds.empty() ? std::nullopt : std::optional(median(found.rounds)); }},
             {"round_seconds", "s", "time of each round, separated by spaces",
              [](const N& found) { return joined_numbers(found.rounds); }}};
}

Columns<StepOfGrid> step_columns() {
  return scheme_columns<StepOfGrid>() +
         Columns<StepOfGrid>{{"t", "", "time of a node", &StepOfGrid::t, in_key},
                             {"step", "", "length of the interval that begins at this node", &StepOfGrid::step},
                             {"motion", "", "first component of q divided by its largest value", &StepOfGrid::motion}};
}

}  // namespace dmocbench
