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
  const auto lower = program.variable_lower().array();
  const auto upper = program.variable_upper().array();
  return (lower == upper || (x.array() > lower + margin && x.array() < upper - margin)).all();
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
  const Eigen::Index n = at.point.size();
  const Eigen::Index m = at.constraints.size();
  const Eigen::SparseMatrix<double> matrix = kkt_matrix(hessian_at(program, at.point, solution.multipliers), 0.0,
                                                        at.jacobian, free_variables(program), equality_rows(program));
  Eigen::VectorXd right_hand_side(n + m);
  const Eigen::VectorXd gradient = at.gradient + at.jacobian.transpose() * solution.multipliers;
  right_hand_side << (program.variable_lower().array() == program.variable_upper().array()).select(0.0, -gradient),
      program.constraint_lower() - at.constraints;
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
  for (int steps = 0; steps < most_steps; ++steps) {
    Solution next = stepped(program, factorisation, solution);
    const bool is_better = residual_of(next) < residual_of(solution);
    if (!is_better && !is_rounding(program, next)) return steps;
    solution = std::move(next);
    if (!is_better) return steps + 1;
  }
  return most_steps;
}

}  // namespace dmocbench
