#include "methods/extensions/primitives/trim.hpp"

#include <span>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

namespace {

/// The equations of a trim at the inputs (q, c, u).
ExpressionVector equations_of_trim(const TracedProblem& traced, const SymmetryGroup& group) {
  InputCounter inputs;
  const ExpressionVector q = inputs.take(traced.configuration_size());
  const ExpressionVector rates = inputs.take(group.dimension());
  const ExpressionVector u = inputs.take(traced.control_size());
  const ExpressionVector v = group.traced_velocity(q, rates);
  const ExpressionVector acceleration = jacobian(v, q) * v;
  const TracedProblem::Values values = traced.at(ControlledState{.q = q, .v = v, .u = u, .t = Expression(0.0)});
  const ExpressionVector inertia = values.mass * acceleration;
  const ExpressionVector transport = values.momentum_by_configuration * v;
  ExpressionVector equations(q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    equations[i] = inertia[i] + transport[i] + values.momentum_by_time[i] - values.generalised_force[i];
  }
  return equations;
}

}  // namespace

TrimSolver::TrimSolver(const Problem& problem, const SymmetryGroup& group)
    : problem_(problem), group_(group), n_(problem.configuration_size()) {
  const ExpressionVector equations = equations_of_trim(TracedProblem(problem), group);
  const ExpressionMatrix derivative =
      jacobian(equations, input_vector(0, n_ + group.dimension() + problem.control_size()));
  std::vector<Expression> outputs(equations.begin(), equations.end());
  append(outputs, derivative);
  schedule_ = Schedule(outputs);
}

Eigen::VectorXd TrimSolver::point_of(const Trim& trim) const {
  if (trim.q.size() != n_ || trim.rates.size() != group_.dimension() || trim.u.size() != problem_.control_size()) {
    throw Error("the guess of a trim of {} needs {} configurations, {} rates and {} controls", problem_.name(), n_,
                group_.dimension(), problem_.control_size());
  }
  Eigen::VectorXd point(n_ + trim.rates.size() + trim.u.size());
  point << trim.q, trim.rates, trim.u;
  return point;
}

std::vector<double> TrimSolver::values_at(const Eigen::VectorXd& point) const {
  return replay<double>(schedule_, std::span<const double>(point.data(), static_cast<std::size_t>(point.size())));
}

Trim TrimSolver::solve(const Trim& guess, const std::vector<Eigen::Index>& unknowns) const {
  constexpr int most_iterations = 50;
  constexpr double tolerance = 1e-13;
  constexpr double shift = 1e-14;  // of J Jᵀ, where equations hold for any unknowns
  Eigen::VectorXd point = point_of(guess);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const std::vector<double> values = values_at(point);
    const Eigen::VectorXd residual = Eigen::Map<const Eigen::VectorXd>(values.data(), n_);
    const Eigen::Map<const Eigen::MatrixXd> derivative(values.data() + n_, n_, point.size());
    if (!residual.allFinite()) break;
    const bool is_last = residual.lpNorm<Eigen::Infinity>() <= tolerance * (1.0 + derivative.lpNorm<Eigen::Infinity>());
    const Eigen::MatrixXd moved = derivative(Eigen::all, unknowns);
    const Eigen::MatrixXd normal = moved * moved.transpose();
    const Eigen::MatrixXd shifted = normal + shift * (1.0 + normal.trace()) * Eigen::MatrixXd::Identity(n_, n_);
    const Eigen::VectorXd step = moved.transpose() * solve_square<double, 1>(shifted, residual);
    if (!step.allFinite()) break;
    point(unknowns) -= step;
    if (!is_last) continue;
    const Eigen::VectorXd q = point.head(n_);
    const Eigen::VectorXd rates = point.segment(n_, group_.dimension());
    return {.q = q, .rates = rates, .u = point.tail(guess.u.size()), .state = {q, group_.velocity(q, rates)}};
  }
  throw Error("Newton's method did not converge to a relative equilibrium of {} from its guess", problem_.name());
}

}  // namespace dmocbench
