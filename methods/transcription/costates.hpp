#pragma once

#include <Eigen/Core>

#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// Costates at the nodes: ψ_k = ∂V_k/∂(q_k, p_k), the gradient of the optimal (true) cost-to-go.
struct Costates {
  Eigen::MatrixXd psi_q;  ///< (N + 1) × n
  Eigen::MatrixXd psi_p;  ///< (N + 1) × n
};

/// Costates by the one formula for every method: with ℓ_k(z) = cost + multipliers · rows of element k, the cost-to-go
/// from node k depends on x_k only through element k, so ψ_k = ∂ℓ_k/∂x_k with respect to the left node (at the last
/// node -∂ℓ_{N-1}/∂x_N with respect to the right one).
///
/// DMOC: ψ^p_k is the multiplier of node k's row, ψ^q_k = ∂ℓ_k/∂q_k. Hamiltonian: x = (q, p), as it stands.
/// Tangent-space: x = (q, v), carried over by ψ^p = L_vv⁻¹ ψ^v, ψ^q = ψ^q̃ - (∂p/∂q)ᵀ ψ^p. `v` are the node velocities,
/// (N + 1) × n.
[[nodiscard]] Costates costates(Transcription& transcription, const Eigen::VectorXd& primal,
                                const Eigen::VectorXd& multipliers, const Eigen::MatrixXd& v);

}  // namespace dmocbench
