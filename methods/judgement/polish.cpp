#include "methods/judgement/polish.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "methods/judgement/confirm.hpp"
#include "methods/judgement/newton_correction.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

namespace {

/// The larger of both residuals; infinity where one is not finite.
double residual_of(const Solution& solution) {
  const double stationarity = solution.kkt_residual.value_or(unbounded);
  const double violation = solution.constraint_violation.value_or(unbounded);
  if (!std::isfinite(stationarity) || !std::isfinite(violation)) return unbounded;
  return std::max(stationarity, violation);
}

/// True if what is left is no more than the rounding of the program's terms.
bool is_rounding(NonlinearProgram& program, const Solution& solution) {
  constexpr double nothing = std::numeric_limits<double>::min();
  return scaled_residual(program, nothing, solution) <= 1.0;
}

bool is_unsettled(const Solution& solution) {
  return solution.status == Status::not_confirmed && solution.correction.value_or(0.0) > settled;
}

bool has_own_multipliers(const NonlinearProgram& program, const Solution& solution) {
  return !solution.multipliers_are_estimated &&
         static_cast<std::size_t>(solution.multipliers.size()) == program.constraint_count();
}

/// The Newton step from a point; none where it cannot be computed, or a limit came first.
std::optional<NewtonCorrection> correction_in_time(NewtonCorrections& corrections, const Solution& solution) {
  try {
    return corrections.at(solution.primal, solution.multipliers);
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

/// The solution after a Newton step that stays within the bounds.
Solution stepped(NonlinearProgram& program, const NewtonCorrection& correction, const Solution& solution) {
  Solution next = solution;
  next.primal =
      (solution.primal + correction.primal).cwiseMax(program.variable_lower()).cwiseMin(program.variable_upper());
  next.multipliers += correction.multipliers;
  judge_residuals(program, next);
  return next;
}

}  // namespace

int polish(NonlinearProgram& program, Solution& solution, int most_steps) {
  if (!is_solved(solution.status) || !has_own_multipliers(program, solution)) return 0;
  NewtonCorrections corrections(program, NewtonCorrections::Factorisation::sparse);
  int steps = 0;
  bool is_better = true;
  while (is_better && steps < most_steps && !must_stop()) {
    const auto correction = correction_in_time(corrections, solution);
    if (!correction) break;
    Solution next = stepped(program, *correction, solution);
    is_better = residual_of(next) < residual_of(solution);
    if (!is_better && !is_rounding(program, next)) break;
    solution = std::move(next);
    ++steps;
  }
  return steps;
}

int settle(NonlinearProgram& program, double tolerance, Solution& solution, int most_steps) {
  if (!is_unsettled(solution) || !has_own_multipliers(program, solution)) return 0;
  NewtonCorrections corrections(program, NewtonCorrections::Factorisation::sparse);
  Solution next = solution;
  for (int steps = 1; steps <= most_steps; ++steps) {
    const auto correction = correction_in_time(corrections, next);
    if (must_stop()) {
      tell_of_stop(solution);
      return 0;
    }
    if (!correction) break;
    next = stepped(program, *correction, next);
    next.status = Status::solved;
    confirm(program, tolerance, next);
    if (is_solved(next.status)) {
      next.message += fmt::format(" It took {} Newton steps behind the solver to settle the answer.", steps);
      solution = std::move(next);
      return steps;
    }
  }
  return 0;
}

}  // namespace dmocbench
