#pragma once

#include <Eigen/Core>

#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// Costates at the nodes: ψ_k = ∂V_k/∂(q_k, p_k), the gradient of the optimal (true) cost-to-go.
struct Costates {
  Eigen::MatrixXd psi_q;  ///< (N + 1) × n
  Eigen::MatrixXd psi_p;  ///< (N + 1) × n
  Eigen::MatrixXd psi_y;  ///< ∂V_k/∂y_k at fixed (q_k, p_k), (N + 1) × l
};

/// Costates by one formula for all methods: with ℓ_k(z) = cost + multipliers · rows of element k, the cost-to-go
/// from node k depends on x_k only through element k, so ψ_k = ∂ℓ_k/∂x_k with respect to the left node (at the last
/// node -∂ℓ_{N-1}/∂x_N with respect to the right one).
///
/// DMOC: ψ^p_k is the multiplier of node k's row, ψ^q_k = ∂ℓ_k/∂q_k. Hamiltonian: x = (q, p), as it stands.
/// Tangent-space: x = (q, v), carried over by ψ^p = L_vv⁻¹ ψ^v, ψ^q = ψ^q̃ - (∂p/∂q)ᵀ ψ^p, ψ^y = ψ^ỹ - (∂p/∂y)ᵀ ψ^p.
/// `v` are the node velocities, (N + 1) × n.
[[nodiscard]] Costates costates(Transcription& transcription, const Eigen::VectorXd& primal,
                                const Eigen::VectorXd& multipliers, const Eigen::MatrixXd& v);

/// Moves costates of a problem with constraints to the projected momenta of a trajectory, from momenta that
/// are larger by Gᵀμ = `gaps`, (N + 1) × n. The gradient of the cost-to-go is determined along motions only, δq and δp
/// that keep g = 0 and G H_p = 0, A among the rows of G; of all ψ with the same values there, those with G ψ^p = 0 and
/// ∂g/∂q ψ^q = 0 are taken, for all methods alike.
void move_to_projected_momenta(const TracedProblem& problem, const Eigen::MatrixXd& gaps, const Trajectory& trajectory,
                               Costates& psi);

/// Costates at the stages: the Ψ_i of the adjoint scheme (eq:stateco7, eq:stateco8), in the sign and unit of
/// `Costates`. Row k s + i is stage i of interval k.
struct StageCostates {
  Eigen::MatrixXd psi_q;  ///< N s × n
  Eigen::MatrixXd psi_p;  ///< N s × n
  Eigen::MatrixXd psi_y;  ///< N s × l, at fixed (q, p)
};

/// Stage costates read off the multipliers. No coefficient of the adjoint scheme enters, so that the scheme can be
/// checked against them.
///
/// With F = L_q + f, interval k costs ℓ = h Σ b_i C + multipliers · rows, and x_{k+1} = x_k + h Σ b_j K_j is worth
/// ψ_{k+1}·x_{k+1} from there on. Ψ^p_i and the stage rate w_i of ψ^p are read off:
///   - Hamiltonian: α_i of the row P_i - L_v, β_i of the row Ṗ_i - F. Stationarity in Ṗ_j reads
///     -β_j/(h b_j) = ψ^p_{k+1} + Σ_i (ã_ij/b_j) α_i. Hence Ψ^p_i = -β_i/(h b_i), w_i = -α_i/(h b_i).
///   - DMOC: rows are variations of h Σ b_i [L + f·δQ_i] in q_k, q_{k+1} and Q̇_j, so the multipliers λ_k, λ_{k+1} and
///     μ_j/(h b_j) are a variation themselves: w_i = δQ̇_i, Ψ^p_i = δQ_i = λ_k + h Σ_j a_ij w_j.
/// For both, Ψ^q_i = -(C_v + F_vᵀΨ^p_i + L_vv w_i): this is w = -∂H/∂p at the stage, H = C + Ψ^q·v + Ψ^p·F and v = v(q,
/// p).
///   - Tangent-space: α_i of Q̇_i - V_i, β_i of d/dt L_v - F: Ψ^p_i = -β_i/(h b_i), Ψ^q_i = -α_i/(h b_i) - L_vqᵀΨ^p_i.
///
/// First-order states add the row γ_i of Ẏ_i - g for all: Ψ^y_i = -γ_i/(h b_i), and g_vᵀΨ^y_i to the bracket of Ψ^q_i.
/// Integral constraints take their prices times c from C.
///
/// `multipliers` has an entry per constraint of the program; `trajectory` holds its nodes and stages.
[[nodiscard]] StageCostates stage_costates(const Transcription& transcription, const Eigen::VectorXd& multipliers,
                                           const Trajectory& trajectory);

}  // namespace dmocbench
