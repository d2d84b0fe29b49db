#include "methods/solvers/confirm.hpp"

#include <algorithm>

#include "methods/program/kkt_residual.hpp"

namespace dmocbench {

namespace {

bool confirms(const NonlinearProgram& program, double tolerance, const Solution& solution) {
  const double floor = program.rounding_floor();
  if (!(*solution.constraint_violation <= confirmation_factor * std::max(tolerance, floor))) return false;
  if (!solution.kkt_residual) return true;
  constexpr double multiplier_scale = 100.0;
  const bool has_multipliers = solution.multipliers.size() > 0;
  const double mean =
      has_multipliers ? solution.multipliers.lpNorm<1>() / static_cast<double>(solution.multipliers.size()) : 0.0;
  const double largest = has_multipliers ? solution.multipliers.lpNorm<Eigen::Infinity>() : 0.0;
  const double allowed = confirmation_factor *
                         std::max(tolerance * std::max(1.0, mean / multiplier_scale), floor * std::max(1.0, largest));
  return *solution.kkt_residual <= allowed;
}

}  // namespace

void confirm(NonlinearProgram& program, double tolerance, Solution& solution) {
  if (static_cast<std::size_t>(solution.primal.size()) != program.variable_count()) {
    if (is_solved(solution.status)) solution.status = Status::not_confirmed;  // nothing to look at
    solution.message = sentence_of(solution.status);
    return;
  }
  solution.objective = program.objective(solution.primal);
  if (static_cast<std::size_t>(solution.multipliers.size()) == program.constraint_count()) {
    const KktResidual residual = kkt_residual(program, solution.primal, solution.multipliers);
    solution.kkt_residual = residual.stationarity;
    solution.constraint_violation = residual.constraint_violation;
  } else {
    solution.constraint_violation = constraint_violation(program, solution.primal);
  }
  const bool claims_success = solution.status == Status::solved || solution.status == Status::acceptable;
  if (!claims_success) return;
  if (confirms(program, tolerance, solution)) {
    solution.status = Status::solved;
  } else if (solution.status == Status::solved) {
    solution.status = Status::not_confirmed;
  }
  solution.message = sentence_of(solution.status);
}

}  // namespace dmocbench
