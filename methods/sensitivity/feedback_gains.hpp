#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The optimal feedback near an optimal motion: u = U_i + K ((q, p) - (q_k, p_k)) for stage i of interval k, where
/// (q, p) is the measured state at node k. To first order this is the optimal control from there on.
struct FeedbackGains {
  /// Entry k s + i is K for stage i of interval k, an m × 2n matrix. It is empty for the last intervals before a
  /// prescribed end, from which the remaining controls cannot reach that end from every neighbouring state.
  std::vector<Eigen::MatrixXd> of_stages;
};

/// The gains along a solution: `primal` and `multipliers` of a solved program, variable_count() and constraint_count()
/// entries. All families have the state (q, p), so that DMOC and Hamiltonian collocation have the same gains (th:equi);
/// gains of tangent-space collocation in (q, v) are carried over by δp = L_vq δq + L_vv δv.
///
/// From the last node to the first, the pairs (δx_k, δψ_k) of a deviation of the state and of the costate, along which
/// the linearised conditions of all later intervals hold, are a space of dimension 2n: Riccati's recursion, which needs
/// no cost-to-go where a prescribed end makes it infinite. Where the space has a δx_k for every deviation, the controls
/// that belong to it are K δx_k. Bounds and inequalities are active as in the solution: a control on its bound
/// has gain 0.
///
/// Throws `Error` if a size is wrong, or the optimal control does not follow from the state at a node alone: with a
/// free horizon, boundary conditions, controls that two intervals share, and in Mayer form.
[[nodiscard]] FeedbackGains feedback_gains(Transcription& program, const Eigen::VectorXd& primal,
                                           const Eigen::VectorXd& multipliers);

}  // namespace dmocbench
