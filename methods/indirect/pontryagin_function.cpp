#include "methods/indirect/pontryagin_function.hpp"

#include <vector>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

PontryaginFunction::PontryaginFunction(const Problem& problem)
    : n_(problem.configuration_size()), m_(problem.control_size()), cost_scale_(problem.cost_scale()) {
  const TracedProblem traced(problem);
  const Eigen::Index size = state_size() + algebraic_size();
  const ExpressionVector point = input_vector(0, size);
  const ExpressionVector q = point.segment(0, n_);
  const ExpressionVector p = point.segment(n_, n_);
  const ExpressionVector psi_q = point.segment(2 * n_, n_);
  const ExpressionVector psi_p = point.segment(3 * n_, n_);
  const ExpressionVector v = point.segment(4 * n_, n_);
  const ExpressionVector u = point.segment(5 * n_, m_);
  const ExpressionVector w = point.segment(5 * n_ + m_, n_);
  ExpressionVector time(1);
  time << Expression::input(static_cast<std::size_t>(size));

  const TracedProblem::Values values = traced.at(ControlledState{q, v, u, time[0]});
  const Expression cost = cost_scale_ * values.running_cost;
  const Expression lambda = cost + psi_q.dot(v) + psi_p.dot(values.generalised_force) + w.dot(values.momentum - p);
  autonomous_ = gradient(lambda, time)[0].is_zero();

  ExpressionVector outputs(2 + size + size * size);
  outputs << cost, lambda, gradient(lambda, point), hessian(lambda, point).reshaped();
  schedule_ = Schedule(outputs);
}

PontryaginFunction::Values PontryaginFunction::evaluate(const Eigen::VectorXd& y, double t, Eigen::VectorXd& z) const {
  constexpr int most_steps = 30;
  // Convergence is quadratic: a step of this size leaves an error of rounding.
  constexpr double last_step = 1e-10;
  const Eigen::Index size_y = state_size();
  const Eigen::Index size_z = algebraic_size();
  const Eigen::Index size = size_y + size_z;
  std::vector<double> inputs(static_cast<std::size_t>(size) + 1);
  Eigen::Map<Eigen::VectorXd> point(inputs.data(), size);
  point.head(size_y) = y;
  inputs.back() = t;

  bool converged = false;
  for (int step = 0; step <= most_steps; ++step) {
    point.tail(size_z) = z;
    const std::vector<double> outputs = replay<double>(schedule_, inputs);
    const Eigen::Map<const Eigen::VectorXd> derivative(outputs.data() + 2, size);
    const Eigen::Map<const Eigen::MatrixXd> curvature(outputs.data() + 2 + size, size, size);
    const Eigen::MatrixXd curvature_z = curvature.bottomRightCorner(size_z, size_z);
    if (!converged) {
      const Eigen::VectorXd correction = solve_square(curvature_z, Eigen::VectorXd(derivative.tail(size_z)));
      if (!correction.allFinite()) {
        throw Error(
            "H_u = 0 has no solution u(x, psi): H_uu or L_vv is singular; the indirect method needs a regular "
            "Lagrangian and a running cost that is strictly convex in the control");
      }
      z -= correction;
      converged = correction.lpNorm<Eigen::Infinity>() <= last_step * (1.0 + z.lpNorm<Eigen::Infinity>());
      continue;
    }
    const Eigen::Index half = 2 * n_;
    const Eigen::MatrixXd curvature_zy = curvature.bottomLeftCorner(size_z, size_y);
    // lazyProduct: the blocked product costs seconds of compile time and pays off only for large matrices.
    const Eigen::MatrixXd reduced =
        curvature.topLeftCorner(size_y, size_y) -
        curvature.topRightCorner(size_y, size_z).lazyProduct(solve_square(curvature_z, curvature_zy));
    Values values;
    values.rate.resize(size_y);
    values.rate << derivative.segment(half, half), -derivative.head(half);
    values.rate_jacobian.resize(size_y, size_y);
    values.rate_jacobian << reduced.bottomRows(half), -reduced.topRows(half);
    values.control_hessian = curvature.block(5 * n_, 5 * n_, m_, m_);
    values.running_cost = outputs[0];
    values.hamiltonian = outputs[1];
    values.hamiltonian_terms = std::abs(outputs[0]) + values.rate.head(half).cwiseAbs().dot(y.tail(half).cwiseAbs());
    return values;
  }
  throw Error("Newton's method did not solve H_u = 0 for the control; start from a finer direct solution");
}

}  // namespace dmocbench
