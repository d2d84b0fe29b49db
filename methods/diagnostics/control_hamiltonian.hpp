#pragma once

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/trajectory.hpp"

namespace dmocbench {

/// The optimal control Hamiltonian H = C + ψ_q·q̇ + ψ_p·(L_q + f) of the maximum principle along a discrete motion,
/// evaluated at the nodes, N + 1 entries. The control at a node is the stage polynomial of the interval to its right,
/// at the last node of that to its left.
///
/// Where nothing depends on time H is constant along exact solutions; where the horizon is free, H(T) - ψ_p·L_vt(T) +
/// ∂Φ/∂T = 0, the middle term because the end prescribes, and Φ is given, velocities, while ψ belongs to momenta. Of a
/// discrete solution both hold up to its order, since H_u = 0 forgives the error of the control. Path constraints that
/// are active at a node do not enter, so there H is that of the motion, not of its Lagrangian. Throws `Error` if the
/// trajectory has no costates.
[[nodiscard]] Eigen::VectorXd control_hamiltonian(const Problem& problem, const Trajectory& trajectory);

/// H(T) - ψ_p·L_vt(T) + ∂Φ/∂T: what the condition of a free horizon leaves at its end. Where a bound on T is active it
/// is the multiplier of that bound; boundary conditions that depend on T would add their own terms, which a trajectory
/// does not carry.
[[nodiscard]] double free_horizon_residual(const Problem& problem, const Trajectory& trajectory);

}  // namespace dmocbench
