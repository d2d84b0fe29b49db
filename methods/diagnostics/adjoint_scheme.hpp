#pragma once

#include <optional>

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// Coefficients of the adjoint partitioned Runge-Kutta scheme (eq:stateco9), s × s each:
/// ā^q_ij = b_j - b_j a_ji / b_i for ψ^q, ā^p_ij = b_j - b_j ã_ji / b_i for ψ^p; the weights are the states' weights.
/// By (th:orderapp) they are (Ã, A): the scheme of (q, p) serves (ψ^p, ψ^q).
struct AdjointCoefficients {
  Eigen::MatrixXd a_q;  ///< of the scheme for ψ^q, s × s
  Eigen::MatrixXd a_p;  ///< of the scheme for ψ^p, s × s
};

/// The coefficients of the adjoint scheme of a tableau (A, b, c).
[[nodiscard]] AdjointCoefficients adjoint_coefficients(const Tableau& tableau);

/// The residual of costates and stage costates in the adjoint scheme, the largest entry of any interval. Residuals of
/// ψ^q are relative to the largest |ψ^q| of the nodes, residuals of ψ^p and ψ^y likewise: pure numbers. ψ^y takes the
/// coefficients of ψ^q, as y takes the ones of q.
struct AdjointResidual {
  double step_q = 0.0;   ///< ψ^q_{k+1} - ψ^q_k - h Σ b_i φ^q_i (eq:stateco5)
  double step_p = 0.0;   ///< ψ^p_{k+1} - ψ^p_k - h Σ b_i φ^p_i (eq:stateco6)
  double stage_q = 0.0;  ///< Ψ^q_i - ψ^q_k - h Σ ā^q_ij φ^q_j (eq:stateco7)
  double stage_p = 0.0;  ///< Ψ^p_i - ψ^p_k - h Σ ā^p_ij φ^p_j (eq:stateco8)
  double step_y = 0.0;   ///< ψ^y_{k+1} - ψ^y_k - h Σ b_i φ^y_i; 0 without first-order states
  double stage_y = 0.0;  ///< Ψ^y_i - ψ^y_k - h Σ ā^q_ij φ^y_j
  /// H_u = C_u + f_uᵀΨ^p_i + g_uᵀΨ^y_i (eq:DMOC_adjoint5) relative to the largest |C_u|, or to the largest |ψ^p| where
  /// C does not depend on u; none where intervals share controls, which are then stationary for the sum of two stages
  /// only.
  std::optional<double> control = {};

  /// The largest of all entries.
  [[nodiscard]] double largest() const;
};

/// The residual of a trajectory's costates with φ^q = -∂H/∂q, φ^p = -∂H/∂p of the pre-Hamiltonian
/// H(q, p, y, ψ, u) = C + ψ^q·v + ψ^p·(L_q + f) + ψ^y·g, v = v(q, p, y), at the stages (Q_i, P_i, Ψ_i, U_i). Its
/// derivatives are taken of the problem's traced formulas; no derivative of any program enters. It is of rounding size
/// for DMOC and Hamiltonian collocation, O(h^2s) for tangent-space collocation where L_vv depends on q. Throws `Error`
/// without costates, or if L_vv is singular.
[[nodiscard]] AdjointResidual adjoint_residual(const Problem& problem, const Trajectory& trajectory,
                                               const AdjointCoefficients& coefficients);

}  // namespace dmocbench
