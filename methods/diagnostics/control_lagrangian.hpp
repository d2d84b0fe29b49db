#pragma once

#include <cstdint>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The two forms in which an optimal control problem is the variational problem of a Lagrangian in (q, ξ): the cost
/// with the equations of motion added by a multiplier ξ, after an integration by parts,
/// Λ(q, q̇, ξ, ξ̇, u) = C + ξ·F + ξ̇·P.
enum class ControlLagrangianForm : std::uint8_t {
  forced_euler_lagrange,  ///< d/dt L_v = L_q + f: F = L_q + f, P = L_v; ξ = ψ^p
  acceleration,           ///< q̈ = a(q, q̇, u): F = a, P = q̇; ξ = L_vv ψ^p
};

/// The distance of a discrete solution from the midpoint discretisation of such a Lagrangian,
/// S_d = Σ_k h_k Λ((q_k + q_{k+1})/2, (q_{k+1} - q_k)/h_k, (ξ_k + ξ_{k+1})/2, (ξ_{k+1} - ξ_k)/h_k, U_k): the largest
/// residuals of its discrete Euler-Lagrange equations at the inner nodes, divided by the step. The costates at the
/// nodes give ξ. All numbers are dimensionless. They are O(h²) for every consistent method of order two, and rounding
/// for a method whose optimality conditions are these equations.
struct ControlLagrangianResidual {
  double adjoint = 0.0;  ///< variations of q, relative to the largest |Λ_q̇| over T
  double motion = 0.0;   ///< variations of ξ, relative to the largest |P| over T
  double control = 0.0;  ///< Λ_u, relative to the largest |C_u|; to 1 where that vanishes
  /// The largest of all.
  [[nodiscard]] double largest() const;
};

/// The residual of a trajectory by a method with one stage, N >= 2, whose controls no bound holds. Throws `Error`
/// without costates, with several stages, or if L_vv is singular on the motion.
[[nodiscard]] ControlLagrangianResidual control_lagrangian_residual(const Problem& problem,
                                                                    const Trajectory& trajectory,
                                                                    ControlLagrangianForm form);

}  // namespace dmocbench
