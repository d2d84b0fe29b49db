#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/transcription/elements/element.hpp"

namespace dmocbench {

/// DMOC: the discrete Lagrange-d'Alembert principle, (eq:varmech_dldap), with the discrete Lagrangian (eq:DMOC_RK_L)
/// and the discrete forces (eq:DMOC_RK_f) of a Butcher tableau.
///
/// Node: q_k. Stages: Q_i = q_k + h Σ_j a_ij Q̇_j. With the action A = h Σ b_i L(Q_i, Q̇_i) and the virtual work
/// W[δ] = h Σ b_i f(Q_i, Q̇_i, U_i)·δQ_i the equations are
///   node k:      ∂A/∂q_k + W[∂/∂q_k]          from the interval to its right,
///   node k + 1:  ∂A/∂q_{k+1} + W[∂/∂q_{k+1}]  from the interval to its left; the sum of both at a node is the forced
///                discrete Euler-Lagrange equation (DEL) (unit: momentum),
///   stages:      (∂A/∂Q̇_j + W[∂/∂Q̇_j]) / (h b_j) = 0, j = 1 .. s-1 (unit: momentum).
/// Holonomic constraints g(q) = 0 (DMOCC), by Gauss with one stage or Lobatto: λ_k at node k and, by Lobatto, λ_i at
/// the interior stages. The equation of node k gets -h w Gᵀ(q_k) λ_k from the interval to its right, w = ½ (Gauss) or
/// b_1, so that λ_k refers to the step of its right interval; work is done by -Gᵀ(Q_i) λ_i at
/// interior stages. Further equations of the interval: g(Q_i) = 0 there and g(q_{k+1}) = 0. Node N has a multiplier of
/// its own (`end_functions`).
/// Velocity constraints A(q) q̇ = 0 (one Gauss stage) have the same multipliers and forces -Aᵀ(q_k) λ_k; their further
/// equation is A(Q_1) Q̇_1 = 0, in the middle.
/// With an embedding q = Φ(θ) in their place (one Gauss stage) nodes carry θ: the interval reaches from Φ(θ_k) to
/// Φ(θ_{k+1}), and its terms are derivatives by θ.
/// Momenta: the forced discrete Legendre transforms (eq:varmech_dlegf), p_k = -(term at node k) and
/// p_{k+1} = (term at node k + 1). The conditions at the first and last node, (eq:gDLOCP3) and (rem:inifinalvel), are
/// in `program_bounds` and `end_functions`.
class DmocElement final : public Element {
 public:
  DmocElement()
      : Element("dmoc", "Discrete Mechanics and Optimal Control: the discrete Lagrange-d'Alembert principle for q",
                NodeState::configuration) {}
  [[nodiscard]] Eigen::Index multipliers(const Tableau& tableau) const override;
  [[nodiscard]] std::vector<bool> velocity_multipliers(const Tableau& tableau) const override;
  [[nodiscard]] bool takes_embedding(const Tableau& tableau) const override { return tableau.stages() == 1; }
  [[nodiscard]] IntervalTrace trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const override;
};

/// The motion of an interval at its stages, as functions of the interval's unknowns: an entry per stage each.
struct StagePath {
  std::vector<ExpressionVector> configurations;  ///< Q_i
  std::vector<ExpressionVector> rates;           ///< Q̇_i
  std::vector<ExpressionVector> controls;        ///< U_i
};

/// The formulas above for any path, with the tableau as the quadrature of A and W. `rate_weights` are the b_j by which
/// the equations of the unknown rates are divided, one per rate.
[[nodiscard]] IntervalTrace lagrange_d_alembert(const TracedProblem& problem, const Tableau& tableau,
                                                const IntervalUnknowns& unknowns, const StagePath& path,
                                                const Eigen::VectorXd& rate_weights);

}  // namespace dmocbench
