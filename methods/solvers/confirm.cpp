#include "methods/solvers/confirm.hpp"

#include <algorithm>
#include <cmath>

#include "methods/program/kkt_residual.hpp"
#include "methods/solvers/stop_rule.hpp"

namespace dmocbench {

Status judged(Status claim, double residual) {
  if (residual <= confirmation_factor) return Status::solved;
  const bool is_near = residual <= confirmation_factor * acceptable_factor;
  return claim == Status::acceptable && is_near ? Status::acceptable : Status::not_confirmed;
}

void judge_residuals(NonlinearProgram& program, Solution& solution) {
  solution.objective = program.objective(solution.primal);
  if (static_cast<std::size_t>(solution.multipliers.size()) != program.constraint_count()) {
    solution.multipliers = least_squares_multipliers(program, solution.primal);
    solution.multipliers_are_estimated = true;
  }
  const KktResidual residual = kkt_residual(program, solution.primal, solution.multipliers);
  solution.kkt_residual = residual.stationarity;
  solution.constraint_violation = residual.constraint_violation;
}

double scaled_residual(const NonlinearProgram& program, double tolerance, const Solution& solution) {
  const StopRule tolerances(program, tolerance);
  const bool has_multipliers = solution.multipliers.size() > 0;
  const double mean =
      has_multipliers ? solution.multipliers.lpNorm<1>() / static_cast<double>(solution.multipliers.size()) : 0.0;
  const double largest = has_multipliers ? solution.multipliers.lpNorm<Eigen::Infinity>() : 0.0;
  const double stationarity = solution.kkt_residual.value_or(unbounded) / tolerances.stationarity(mean, largest);
  const double violation = solution.constraint_violation.value_or(unbounded) / tolerances.violation();
  return std::isnan(stationarity) ? stationarity
         : std::isnan(violation)  ? violation
                                  : std::max(stationarity, violation);
}

void confirm(NonlinearProgram& program, double tolerance, Solution& solution) {
  if (static_cast<std::size_t>(solution.primal.size()) != program.variable_count()) {
    if (!is_solved(solution.status)) return;
    solution.status = Status::not_confirmed;  // nothing to look at
    solution.message = sentence_of(solution.status);
    return;
  }
  judge_residuals(program, solution);
  const bool claims_success = solution.status == Status::solved || solution.status == Status::acceptable;
  if (!claims_success) return;
  solution.status = judged(solution.status, scaled_residual(program, tolerance, solution));
  solution.message = sentence_of(solution.status);
}

}  // namespace dmocbench
