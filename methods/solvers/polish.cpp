#include "methods/solvers/polish.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "methods/solvers/confirm.hpp"
#include "methods/solvers/linearisation.hpp"
#include "methods/solvers/symmetric_factorisation.hpp"

namespace dmocbench {

namespace {

bool has_only_equalities(const NonlinearProgram& program) {
  return (program.constraint_lower().array() == program.constraint_upper().array()).all();
}

/// True if no free variable is at a bound, where the KKT system would differ.
bool is_away_from_bounds(const NonlinearProgram& program, const Eigen::VectorXd& x) {
  constexpr double margin = 1e-6;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double lower = program.variable_lower()[j];
    const double upper = program.variable_upper()[j];
    const bool is_inside = x[j] > lower + margin && x[j] < upper - margin;
    if (lower != upper && !is_inside) return false;
  }
  return true;
}

/// The larger of both residuals; infinity where one is not finite.
double residual_of(const Solution& solution) {
  const double stationarity = solution.kkt_residual.value_or(unbounded);
  const double violation = solution.constraint_violation.value_or(unbounded);
  if (!std::isfinite(stationarity) || !std::isfinite(violation)) return unbounded;
  return std::max(stationarity, violation);
}

/// True if what is left is no more than the rounding of the program's terms.
bool is_rounding(const NonlinearProgram& program, const Solution& solution) {
  constexpr double nothing = std::numeric_limits<double>::min();
  return scaled_residual(program, nothing, solution) <= 1.0;
}

/// The solution after one Newton step; with an infinite residual if there is none.
Solution stepped(NonlinearProgram& program, SymmetricFactorisation& factorisation, const Solution& solution) {
  Solution next = solution;
  Linearisation at = values_at(program, solution.primal);
  differentiate(program, at);
  const std::vector<bool> free = free_variables(program);
  const Eigen::Index n = at.point.size();
  const Eigen::Index m = at.constraints.size();
  const Eigen::SparseMatrix<double> matrix =
      kkt_matrix(hessian_at(program, at.point, solution.multipliers), 0.0, at.jacobian, free, equality_rows(program));
  Eigen::VectorXd right_hand_side(n + m);
  right_hand_side << -(at.gradient + at.jacobian.transpose() * solution.multipliers),
      program.constraint_lower() - at.constraints;
  for (Eigen::Index j = 0; j < n; ++j) {
    if (!free[static_cast<std::size_t>(j)]) right_hand_side[j] = 0.0;
  }
  if (!factorisation.factorise(matrix)) {
    next.kkt_residual = unbounded;
    return next;
  }
  const Eigen::VectorXd step = factorisation.solve(std::move(right_hand_side));
  next.primal += step.head(n);
  next.multipliers += step.tail(m);
  judge_residuals(program, next);
  return next;
}

}  // namespace

int polish(NonlinearProgram& program, Solution& solution, int most_steps) {
  const bool fits = is_solved(solution.status) && !solution.multipliers_are_estimated && has_only_equalities(program) &&
                    static_cast<std::size_t>(solution.multipliers.size()) == program.constraint_count() &&
                    is_away_from_bounds(program, solution.primal);
  if (!fits) return 0;
  SymmetricFactorisation factorisation;
  int steps = 0;
  bool is_better = true;
  while (is_better && steps < most_steps) {
    Solution next = stepped(program, factorisation, solution);
    is_better = residual_of(next) < residual_of(solution);
    if (!is_better && !is_rounding(program, next)) break;
    solution = std::move(next);
    ++steps;
  }
  return steps;
}

}  // namespace dmocbench
