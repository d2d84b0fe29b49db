#pragma once

#include <string>

#include "methods/transcription/element.hpp"

namespace dmocbench {

/// Collocation of the Euler-Lagrange equations on the tangent space by the Runge-Kutta method of a tableau.
///
/// Node: (q_k, v_k). Stages: Q_i = q_k + h Σ a_ij Q̇_j, V_i = v_k + h Σ a_ij V̇_j. Private rows, i = 1 .. s:
///   Q̇_i - V_i = 0                                                        (n rows each, unit: velocity),
///   d/dt L_v - L_q - f = L_vq V_i + L_vv V̇_i + L_vt - L_q - f = 0 at (Q_i, V_i, U_i)  (n rows each, unit: force).
/// Momenta: p = L_v(q, v) at the nodes.
class TangentElement final : public Element {
 public:
  [[nodiscard]] std::string name() const override { return "tangent"; }
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] NodeState node_state() const override { return NodeState::velocity; }
  [[nodiscard]] IntervalTrace trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const override;
};

}  // namespace dmocbench
