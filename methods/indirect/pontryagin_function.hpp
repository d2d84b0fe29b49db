#pragma once

#include <Eigen/Core>

#include "methods/expression/schedule.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Pontryagin's maximum principle for a problem, as derivatives of one traced function:
///
///   Λ(y; z, t) = C(q, v, u) + ψ_q·v + ψ_p·(L_q + f) + w·(L_v - p),   y = (q, p, ψ_q, ψ_p),   z = (v, u, w).
///
/// The pre-Hamiltonian is a function of (q, p, ψ, u) with v = v(q, p). Since L is given in v, the relation p = L_v is
/// kept as a constraint with the multiplier w. All equations are then gradients of Λ, and their Jacobians parts of its
/// Hessian:
///
///   q̇ = Λ_{ψ_q},  ṗ = Λ_{ψ_p},  ψ̇_q = -Λ_q,  ψ̇_p = -Λ_p = w      (state and adjoint equations)
///   0 = Λ_v,  0 = Λ_u,  0 = Λ_w                                    (w; the control from H_u = 0; p = L_v)
///
/// On solutions Λ is the optimal Hamiltonian. ψ is the gradient of the optimal cost-to-go (the sign of `Costates`).
/// The cost is multiplied by `Problem::cost_scale`, and so are ψ, w and Λ.
class PontryaginFunction {
 public:
  /// Traces the problem. Throws `Error` if it is not well posed (see `TracedProblem`).
  explicit PontryaginFunction(const Problem& problem);

  /// n.
  [[nodiscard]] Eigen::Index configuration_size() const noexcept { return n_; }
  /// m.
  [[nodiscard]] Eigen::Index control_size() const noexcept { return m_; }
  /// Entries of y: 4n.
  [[nodiscard]] Eigen::Index state_size() const noexcept { return 4 * n_; }
  /// Entries of z: 2n + m.
  [[nodiscard]] Eigen::Index algebraic_size() const noexcept { return 2 * n_ + m_; }
  /// The factor of C, ψ, w and Λ.
  [[nodiscard]] double cost_scale() const noexcept { return cost_scale_; }
  /// True if time does not enter Λ: the optimal Hamiltonian is then constant along solutions.
  [[nodiscard]] bool is_autonomous() const noexcept { return autonomous_; }

  /// Λ and its derivatives at one point.
  struct Values {
    Eigen::VectorXd rate;             ///< ẏ, 4n entries
    Eigen::MatrixXd rate_jacobian;    ///< dẏ/dy with z eliminated, 4n × 4n
    Eigen::MatrixXd control_hessian;  ///< H_uu, m × m
    double running_cost = 0.0;        ///< C, scaled
    double hamiltonian = 0.0;         ///< Λ
    double hamiltonian_terms = 0.0;   ///< |C| + Σ|ψ_q v| + Σ|ψ_p ṗ|, the magnitude of the terms of Λ
  };

  /// Solves 0 = Λ_z for z by Newton's method from the given z, at y (4n entries) and time t, and returns all values
  /// there. Throws `Error` if Λ_zz is singular (L_vv or H_uu is) or the iteration does not converge.
  [[nodiscard]] Values evaluate(const Eigen::VectorXd& y, double t, Eigen::VectorXd& z) const;

 private:
  Eigen::Index n_;
  Eigen::Index m_;
  double cost_scale_;
  bool autonomous_ = true;
  Schedule schedule_;  // outputs: C, Λ, the gradient of Λ in (y, z), its Hessian column by column
};

}  // namespace dmocbench
