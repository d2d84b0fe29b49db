#pragma once

#include <Eigen/Core>

#include "methods/expression/schedule.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The control that the maximum principle gives: u(q, v, y, ψ_p, ψ_y, t) with H_u = C_u + f_uᵀ ψ_p + g_uᵀ ψ_y = 0, by
/// Newton's method with the exact H_uu.
///
/// At the nodes of a Gauss method with s stages this control has the order 2s of state and costate, where the stage
/// controls have order s + 1 and their polynomial order s.
class ControlFromCostate {
 public:
  /// Traces the problem.
  explicit ControlFromCostate(const Problem& problem);

  /// m entries; Newton's method starts from `start`. ψ_p and ψ_y are gradients of the true cost-to-go. Throws `Error`
  /// if vectors have the wrong size, H_uu is not positive definite or the iteration does not converge.
  [[nodiscard]] Eigen::VectorXd control(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                        const Eigen::VectorXd& psi_p, double t, const Eigen::VectorXd& start,
                                        const Eigen::VectorXd& y = {}, const Eigen::VectorXd& psi_y = {}) const;

  /// The controls at all nodes of a trajectory with costates, (N + 1) × m. Throws `Error` without costates.
  [[nodiscard]] Eigen::MatrixXd at_nodes(const Trajectory& trajectory) const;

 private:
  Eigen::Index n_;
  Eigen::Index m_;
  Eigen::Index l_;
  double cost_scale_;
  Schedule schedule_;  // inputs q, v, u, t, ψ_p, y, ψ_y; outputs H_u, then H_uu column by column, scaled
};

/// Largest difference, over the nodes that both have, of the controls u(x_k, ψ_k) that the maximum principle gives from
/// each trajectory's own state and costate. It has the full order at the nodes, where stage controls have less. 0 if
/// the trajectories share no node. Throws `Error` without costates.
[[nodiscard]] double node_control_error(const Problem& problem, const Trajectory& trajectory,
                                        const Trajectory& reference);

}  // namespace dmocbench
