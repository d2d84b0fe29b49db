#include "methods/judgement/polish.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "methods/judgement/confirm.hpp"
#include "methods/judgement/negative_curvature.hpp"
#include "methods/judgement/newton_correction.hpp"
#include "methods/judgement/stop_rule.hpp"
#include "methods/runtime/numbers_in_text.hpp"
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

/// True if the residual is no more than the rounding of the program's terms.
bool is_rounding(NonlinearProgram& program, const Solution& solution) {
  constexpr double nothing = std::numeric_limits<double>::min();
  return scaled_residual(program, nothing, solution) <= 1.0;
}

bool is_unsettled(const Solution& solution) {
  const bool can_be = solution.status == Status::not_confirmed || solution.status == Status::control_not_determined;
  return can_be && solution.correction.value_or(0.0) > settled;
}

/// True where a solver stopped, or was not confirmed, within a hundred times the tolerance that confirms an answer. Not
/// at a limit of the user's, which is on the solver's own iterations.
bool is_near(NonlinearProgram& program, double tolerance, const Solution& solution) {
  const bool has_stopped = solution.status == Status::not_confirmed || solution.status == Status::acceptable ||
                           solution.status == Status::step_failed;
  if (!has_stopped) return false;
  const double residual = scaled_residual(program, tolerance, solution);
  return residual > confirmation_factor && residual <= confirmation_factor * acceptable_factor;
}

/// True of a solved answer whose residuals exceed the tolerance, but not the possible rounding.
bool is_solved_to_rounding(double tolerance, const Solution& solution) {
  if (!is_solved(solution.status)) return false;
  const double count = std::max(1.0, static_cast<double>(solution.multipliers.size()));
  const double allowed = confirmation_factor * tolerance;
  return solution.constraint_violation.value_or(0.0) > allowed ||
         solution.kkt_residual.value_or(0.0) > allowed * StopRule::scale(solution.multipliers.lpNorm<1>() / count);
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

namespace {

/// Newton steps as long as each leaves less than half of the residual; how many there were.
int steps_to_rounding(NonlinearProgram& program, Solution& solution, int most_steps) {
  constexpr double less = 0.5;
  NewtonCorrections corrections(program, NewtonCorrections::Factorisation::sparse);
  for (int steps = 0; steps < most_steps; ++steps) {
    if (must_stop()) return steps;
    const auto correction = correction_in_time(corrections, solution);
    if (!correction) return steps;
    Solution next = stepped(program, *correction, solution);
    if (!(residual_of(next) < less * residual_of(solution))) return steps;
    solution = std::move(next);
  }
  return most_steps;
}

/// Newton steps until the answer is confirmed; none, and the answer as it was, where they do not get there.
int steps_to_confirmation(NonlinearProgram& program, double tolerance, Solution& solution, int most_steps) {
  NewtonCorrections corrections(program);
  Confirmation confirmation(program);
  const bool was_unsettled = is_unsettled(solution);
  Solution next = solution;
  for (int steps = 1; steps <= most_steps; ++steps) {
    const auto correction = correction_in_time(corrections, next);
    if (must_stop()) {
      if (solution.status == Status::not_confirmed) tell_of_stop(solution);
      return 0;
    }
    if (!correction) return 0;
    next = stepped(program, *correction, next);
    next.status = Status::solved;
    confirmation.judge(tolerance, next);
    if (next.status != Status::solved) continue;
    if (next.curvature) return 0;  // Newton's method leads to saddles too
    // If the cost is so small that any residual passes, an answer whose residuals were large remains unchecked.
    if (!was_unsettled && confirmation.scaling(tolerance, next.primal, next).of_cost != 1.0) return 0;
    next.message += fmt::format(" {} after the last iteration confirmed the solution.", counted(steps, "Newton step"));
    if (solution.status != Status::not_confirmed && !is_solved(solution.status)) {
      next.message += fmt::format(" The solver itself reported \"{}\".", name_of(solution.status));
    }
    solution = std::move(next);
    return steps;
  }
  return 0;
}

/// True also where a limit comes before that is known.
bool may_be_saddle(const NonlinearProgram& program, const LinearisedConditions& at) {
  try {
    return negative_curvature(program, at).has_value();
  } catch (const Stopped&) {
    return true;
  }
}

/// An answer that no Newton step settles is solved all the same if trajectories on both sides of it, along the step,
/// meet the conditions as well and cost the same: it is one of many.
void tell_of_equal_neighbours(NonlinearProgram& program, double tolerance, Solution& solution) {
  constexpr double distance = 10.0 * settled;
  constexpr double same_cost = 1e-8;
  NewtonCorrections corrections(program, NewtonCorrections::Factorisation::sparse);
  const auto correction = correction_in_time(corrections, solution);
  if (!correction || !(correction->length > settled)) return;
  if (may_be_saddle(program, corrections.conditions())) return;  // there the cost is flat, too
  const double share = std::min(1.0, distance / correction->length);
  for (const double factor : {share, -share}) {
    const NewtonCorrection part{.primal = factor * correction->primal, .multipliers = factor * correction->multipliers};
    const Solution next = stepped(program, part, solution);
    const bool is_kept_by_bounds = (next.primal - solution.primal).norm() < 0.5 * part.primal.norm();
    const double cost_moves = std::abs(next.objective - solution.objective);
    if (is_kept_by_bounds || !(cost_moves <= same_cost * std::max(1.0, std::abs(solution.objective)))) return;
    if (!(scaled_residual(program, tolerance, next) <= confirmation_factor)) return;
  }
  solution.status = Status::solved;
  solution.message = fmt::format(
      "{} The tolerance does not determine the trajectory: neighbours on both sides, at a distance of {:.0e} of its "
      "size, satisfy all conditions at the same cost. A small term in the cost, such as the square of a control, would "
      "select one trajectory.",
      sentence_of(solution.status), share * correction->length);
}

}  // namespace

int settle(NonlinearProgram& program, double tolerance, Solution& solution) {
  constexpr int most_steps = 10;
  if (!has_own_multipliers(program, solution)) return 0;
  int steps = 0;
  if (is_unsettled(solution) || is_near(program, tolerance, solution)) {
    steps = steps_to_confirmation(program, tolerance, solution, most_steps);
  }
  if (solution.status == Status::not_confirmed && is_unsettled(solution) && !must_stop()) {
    tell_of_equal_neighbours(program, tolerance, solution);
  }
  if (is_solved_to_rounding(tolerance, solution)) steps += steps_to_rounding(program, solution, most_steps);
  return steps;
}

}  // namespace dmocbench
