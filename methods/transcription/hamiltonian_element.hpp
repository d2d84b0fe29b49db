#pragma once

#include <string>

#include "methods/transcription/element.hpp"

namespace dmocbench {

/// Collocation of the Hamiltonian system by the symplectic partitioned Runge-Kutta method of a tableau, (eq:dHOCP),
/// written without a Hamiltonian as in (eq:DMOC_RK).
///
/// Node: (q_k, p_k). Stages: Q_i = q_k + h Σ a_ij Q̇_j, P_i = p_k + h Σ ã_ij Ṗ_j. Private rows, i = 1 .. s:
///   P_i - L_v(Q_i, Q̇_i) = 0                          (n rows each, unit: momentum),
///   Ṗ_i - L_q(Q_i, Q̇_i) - f(Q_i, Q̇_i, U_i) = 0      (n rows each, unit: force).
class HamiltonianElement final : public Element {
 public:
  [[nodiscard]] std::string name() const override { return "hamiltonian"; }
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] NodeState node_state() const override { return NodeState::momentum; }
  [[nodiscard]] IntervalTrace trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const override;
};

}  // namespace dmocbench
