#pragma once

#include <Eigen/Core>

#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The multipliers of a program that belong to the costates of a trajectory, constraint_count() entries: with
/// `sample(program, smooth_motion(trajectory))` a warm start. The trajectory may be of another grid, method or tableau.
///
/// The inverse of `costates` and `stage_costates`, in their signs: with ψ^p, ψ^q at the stages and the rate of ψ^p,
/// w = -∂H/∂p = -L_vv⁻¹(C_v + F_vᵀψ^p + ψ^q),
///   - DMOC: ψ^p_k for node k, h b_j w_j for the interval's own row j;
///   - Hamiltonian: -h b_i w_i for P_i - L_v, -h b_i Ψ^p_i for Ṗ_i - F; ∓ψ^p for the rows of the ends' velocities;
///   - tangent-space: -h b_i (Ψ^q_i + L_vqᵀΨ^p_i) for Q̇_i - V_i, -h b_i Ψ^p_i for d/dt L_v - F;
///   - second-order: ψ^p_k for node k, -b_i Ψ^p_i for h (d/dt L_v - F);
///   - first-order states, of all families: -h b_i Ψ^y_i for Ẏ_i - g;
///   - shooting: -h times the costate of (q, v) at node k + 1, which is (ψ^q + L_vqᵀψ^p, L_vv ψ^p).
/// On the trajectory's own grid and tableau its stages are taken as they are, so that the trajectory's program gets its
/// own multipliers back up to rounding, and DMOC and Hamiltonian collocation each other's (th:equi). Elsewhere ψ is
/// the cubic Hermite interpolant of the nodes, with the rates that the adjoint equations give them. A motion with
/// another horizon is stretched to the program's.
///
/// Costates do not determine the multipliers of path constraints, bounds on velocities and boundary conditions; these
/// minimise the remaining gradient (`complete_multipliers`).
///
/// Throws `Error` if the trajectory has no costates.
[[nodiscard]] Eigen::VectorXd sample_multipliers(Transcription& program, const Trajectory& trajectory);

}  // namespace dmocbench
