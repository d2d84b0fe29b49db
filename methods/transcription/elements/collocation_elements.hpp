#pragma once

#include <vector>

#include "methods/transcription/elements/element.hpp"

namespace dmocbench {

/// Collocation of the Hamiltonian system by the symplectic partitioned Runge-Kutta method of a tableau, (eq:dHOCP),
/// written without a Hamiltonian as in (eq:DMOC_RK).
///
/// Node: (q_k, p_k). Stages: Q_i = q_k + h Σ a_ij Q̇_j, P_i = p_k + h Σ ã_ij Ṗ_j. Stage equations, i = 1 .. s:
///   P_i - L_v(Q_i, Q̇_i) = 0                          (n each, unit: momentum),
///   Ṗ_i - L_q(Q_i, Q̇_i) - f(Q_i, Q̇_i, U_i) = 0      (n each, unit: force).
///
/// Holonomic constraints, by Gauss with one stage: p_k - (h/2) Gᵀ(q_k) λ⁺ and p_{k+1} + (h/2) Gᵀ(q_{k+1}) λ⁻ stand in
/// the place of the momenta of the nodes. By Lobatto: the force -Gᵀ(Q_i) λ_i at every stage. Further equations: g = 0
/// at Q_2 .. Q_s (Gauss: at q_{k+1}) and G H_p(q_{k+1}, p_{k+1}) = 0. L has to be quadratic in the velocity, L_vv needs
/// nonzero leading minors. Velocity constraints A(q) q̇ = 0 (one Gauss stage) have the same multipliers and impulses,
/// and A(Q_1) Q̇_1 = 0 in the place of g = 0. With an embedding in their place (one Gauss stage) the equations are p_k =
/// p_k⁻ and p_{k+1} = p_{k+1}⁺, DMOC's momenta.
class HamiltonianElement final : public Element {
 public:
  HamiltonianElement()
      : Element("hamiltonian",
                "collocation of Hamilton's equations in (q, p) with the symplectic partitioned Runge-Kutta method",
                NodeState::momentum) {}
  [[nodiscard]] Eigen::Index multipliers(const Tableau& tableau) const override;
  [[nodiscard]] std::vector<bool> velocity_multipliers(const Tableau& tableau) const override;
  [[nodiscard]] bool takes_embedding(const Tableau& tableau) const override { return tableau.stages() == 1; }
  [[nodiscard]] IntervalTrace trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const override;
};

/// Collocation of the Euler-Lagrange equations on the tangent space by the Runge-Kutta method of a tableau.
///
/// Node: (q_k, v_k). Stages: Q_i = q_k + h Σ a_ij Q̇_j, V_i = v_k + h Σ a_ij V̇_j. Stage equations, i = 1 .. s:
///   Q̇_i - V_i = 0                                                        (n each, unit: velocity),
///   d/dt L_v - L_q - f = L_vq V_i + L_vv V̇_i + L_vt - L_q - f = 0 at (Q_i, V_i, U_i)  (n each, unit: force).
/// Momenta: p = L_v(q, v) at the nodes.
///
/// Holonomic constraints (projected collocation), by Gauss with one or two stages or Lobatto with two or three: the
/// force -Gᵀ(Q_i) λ_i at every stage, and q_{k+1} - h Gᵀμ and v_{k+1} - h Gᵀν stand in the place of the right node in
/// the quadratures, G at (q_k + q_{k+1})/2. Further equations: g = 0 and G v = 0 at the right node, which μ and ν
/// serve, and the acceleration condition G V̇_i + Ġ V_i = 0 at every stage. Gauss with one stage has neither this nor ν:
/// λ_1 serves G v = 0. (Hermite-Simpson collocation in DIRCON, by Posa, Kuindersma and Tedrake, has acceleration
/// conditions at the nodes only and no ν; its order is the same.) Velocity constraints have the same conditions and
/// multipliers, without g = 0 and μ.
class TangentElement final : public Element {
 public:
  TangentElement() : Element("tangent", "collocation of the Euler-Lagrange equations in (q, v)", NodeState::velocity) {}
  [[nodiscard]] Eigen::Index multipliers(const Tableau& tableau) const override;
  [[nodiscard]] std::vector<bool> velocity_multipliers(const Tableau& tableau) const override;
  [[nodiscard]] IntervalTrace trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const override;
};

}  // namespace dmocbench
