#pragma once

#include <cstdint>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

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

/// The multiplier ξ between the nodes.
enum class MultiplierPath : std::uint8_t {
  polynomial,  ///< of the degree of q, by the multipliers of the interval's own equations
  straight,    ///< a straight line: a mistake for degrees above one, for comparison
};

/// The Lagrangian φ + λᵀa of a program of DMOC or of a Galerkin integrator, and the discrete action of the control
/// Lagrangian that it is equal to.
struct GalerkinForm {
  double program = 0.0;  ///< φ + λᵀa, φ the scaled cost
  double action = 0.0;   ///< Σ_k h_k Σ_i b_i Λ(Q_i, V_i, Ξ_i, Ξ'_i, U_i)
  double size = 0.0;     ///< the sum of the magnitudes of its terms
  /// Their difference relative to the size.
  [[nodiscard]] double difference() const;
};

/// Whether a program has it: DMOC or a Galerkin integrator with fixed ends, a cost in Bolza form, and neither bounds on
/// velocities nor integrals, path constraints, constraints g(q) = 0 or first-order states, which add equations.
[[nodiscard]] bool has_galerkin_form(const Transcription& program);

/// Both at any unknowns x and any multipliers λ, for every degree s of q, quadrature (b, c) of r points and control
/// space.
///
/// Λ = C + ξ·(L_q + f) + ξ̇·L_v is the forced form of the control Lagrangian, C scaled as φ. ξ is the polynomial of
/// degree s on each interval that has the multipliers λ_k of the equations of the nodes as values there and the rates
/// μ_j / (h w_j), j < s, at the points where q has the rates Q̇_j: μ_j are the multipliers of the interval's own
/// equations, w_j the weights of these points. The equations vary the action along ξ, so that both numbers are equal as
/// functions of (x, λ), and with them their stationary points: to vary and to discretise commute. Throws `Error`
/// unless `has_galerkin_form`.
[[nodiscard]] GalerkinForm galerkin_form(Transcription& program, const Eigen::VectorXd& x,
                                         const Eigen::VectorXd& multipliers,
                                         MultiplierPath path = MultiplierPath::polynomial);

}  // namespace dmocbench
