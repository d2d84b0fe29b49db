#pragma once

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/trajectory.hpp"

namespace dmocbench {

/// The optimal control Hamiltonian H = C + ψ_q·q̇ + ψ_p·(L_q + f) of the maximum principle along a discrete motion,
/// evaluated at the nodes, N + 1 entries. The control at a node is the stage polynomial of the interval to its right,
/// at the last node of that to its left.
///
/// Where nothing depends on time, H is constant along exact solutions. Where the horizon is free,
/// H(T) - ψ_p·L_vt(T) + ∂Φ/∂T = 0; the middle term is there because ends and Φ are stated in velocities, while ψ
/// belongs to momenta. For discrete solutions both hold up to their order, since H_u = 0 removes the first-order effect
/// of the control's error. Active path constraints do not enter H. Throws `Error` if the trajectory has no costates.
[[nodiscard]] Eigen::VectorXd control_hamiltonian(const Problem& problem, const Trajectory& trajectory);

/// H(T) - ψ_p·L_vt(T) + ∂Φ/∂T, the residual of the condition of a free horizon. Where a bound on T is active, it is the
/// multiplier of that bound. Boundary conditions that depend on T would add terms that a trajectory does not carry.
[[nodiscard]] double free_horizon_residual(const Problem& problem, const Trajectory& trajectory);

}  // namespace dmocbench
