#pragma once

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/trajectory.hpp"

namespace dmocbench {

/// The balance between forces and momentum along a discrete motion (eq:noether_force_d).
struct MomentumConsistency {
  /// Per interval: p_{k+1}·ξ(q_{k+1}) - p_k·ξ(q_k) minus the work of all forces along ξ by the method's own quadrature,
  /// h Σ b_i [L_q·ξ(Q_i) + L_v·Dξ(Q_i)Q̇_i + f·ξ(Q_i)]. N entries.
  Eigen::VectorXd defects;
  double largest = 0.0;        ///< largest magnitude of an interval's defect
  double mean = 0.0;           ///< mean magnitude
  double total = 0.0;          ///< magnitude of their sum: the balance over the whole horizon
  double largest_force = 0.0;  ///< largest magnitude of the force along ξ at a stage, to compare with
};

/// The momenta are those of the trajectory's nodes, one number per node, shared by the two intervals beside it: with
/// both momenta taken from the same interval, the defect would vanish identically. (The last node belongs to one
/// interval only, so for DMOC the defect of the last interval does; the other N - 1 are checks.) Throws `Error` if the
/// problem has no symmetry.
[[nodiscard]] MomentumConsistency momentum_consistency(const Problem& problem, const Trajectory& trajectory);

}  // namespace dmocbench
