#include "methods/indirect/control_from_costate.hpp"

#include <algorithm>
#include <vector>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

ControlFromCostate::ControlFromCostate(const Problem& problem)
    : n_(problem.configuration_size()),
      m_(problem.control_size()),
      l_(problem.first_order_size()),
      cost_scale_(problem.cost_scale()) {
  const auto n = static_cast<std::size_t>(n_);
  const auto m = static_cast<std::size_t>(m_);
  const ControlledState point{input_vector(0, n_), input_vector(n, n_), input_vector(2 * n, m_),
                              Expression::input(2 * n + m), input_vector(3 * n + m + 1, l_)};
  const ExpressionVector psi_p = input_vector(2 * n + m + 1, n_);
  const ExpressionVector psi_y = input_vector(3 * n + m + 1 + static_cast<std::size_t>(l_), l_);
  const TracedProblem::Values values = TracedProblem(problem).at(point);
  Expression hamiltonian = cost_scale_ * values.running_cost;
  for (Eigen::Index i = 0; i < n_; ++i) hamiltonian += psi_p[i] * values.generalised_force[i];
  for (Eigen::Index i = 0; i < l_; ++i) hamiltonian += psi_y[i] * values.first_order_rates[i];
  ExpressionVector outputs(m_ + m_ * m_);
  outputs << gradient(hamiltonian, point.u), hessian(hamiltonian, point.u).reshaped();
  schedule_ = Schedule(outputs);
}

Eigen::VectorXd ControlFromCostate::control(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                            const Eigen::VectorXd& psi_p, double t, const Eigen::VectorXd& start,
                                            const Eigen::VectorXd& y, const Eigen::VectorXd& psi_y) const {
  constexpr int most_steps = 50;
  // Convergence is quadratic: a step of this size leaves an error of rounding.
  constexpr double last_step = 1e-10;
  if (q.size() != n_ || v.size() != n_ || psi_p.size() != n_ || start.size() != m_ || y.size() != l_ ||
      psi_y.size() != l_) {
    throw Error("the control cannot be computed from the costate: a vector has the wrong size");
  }
  std::vector<double> inputs(static_cast<std::size_t>(3 * n_ + m_ + 1 + 2 * l_));
  Eigen::Map<Eigen::VectorXd> point(inputs.data(), std::ssize(inputs));
  Eigen::VectorXd u = start;
  for (int step = 0; step < most_steps; ++step) {
    point << q, v, u, t, cost_scale_ * psi_p, y, cost_scale_ * psi_y;
    const std::vector<double> outputs = replay<double>(schedule_, inputs);
    const Eigen::VectorXd hamiltonian_by_control = Eigen::Map<const Eigen::VectorXd>(outputs.data(), m_);
    const Eigen::MatrixXd curvature = Eigen::Map<const Eigen::MatrixXd>(outputs.data() + m_, m_, m_);
    const std::optional<Eigen::VectorXd> correction = solve_if_positive_definite(curvature, hamiltonian_by_control);
    if (!correction) {
      throw Error(
          "H_u = 0 does not determine the control: H_uu is not positive definite; the running cost must be strictly "
          "convex in the control");
    }
    u -= *correction;
    if (correction->norm() <= last_step * (1e-3 + u.norm())) return u;
  }
  throw Error("Newton's method did not solve H_u = 0 for the control");
}

Eigen::MatrixXd ControlFromCostate::at_nodes(const Trajectory& trajectory) const {
  if (!trajectory.has_costates()) {
    throw Error("controls can be computed only from costates: use the solution of a solver with multipliers");
  }
  const Eigen::Index nodes = trajectory.node_times.size();
  Eigen::MatrixXd controls(nodes, m_);
  for (Eigen::Index k = 0; k < nodes; ++k) {
    const double t = trajectory.node_times[k];
    controls.row(k) = control(trajectory.q.row(k).transpose(), trajectory.v.row(k).transpose(),
                              trajectory.psi_p.row(k).transpose(), t, control_at(trajectory, t),
                              Trajectory::row_of(trajectory.y, k), Trajectory::row_of(trajectory.psi_y, k))
                          .transpose();
  }
  return controls;
}

double node_control_error(const Problem& problem, const Trajectory& trajectory, const Trajectory& reference) {
  const ControlFromCostate principle(problem);
  const Eigen::MatrixXd controls = principle.at_nodes(trajectory);
  const Eigen::MatrixXd exact = principle.at_nodes(reference);
  double largest = 0.0;
  for (Eigen::Index k = 0; k < controls.rows(); ++k) {
    const auto node = node_at(reference.node_times, trajectory.node_times[k]);
    if (node) largest = std::max(largest, (controls.row(k) - exact.row(*node)).norm());
  }
  return largest;
}

}  // namespace dmocbench
