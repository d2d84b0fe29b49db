#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

/// The forced Euler-Lagrange equations (eq:varmech_FEL), solved for the acceleration:
/// L_vv q̈ = L_q + f - L_vq q̇ - L_vy ẏ - L_vt; with constraints g(q) = 0 or A(q) q̇ = 0 their index is reduced:
/// L_vv q̈ + Gᵀλ is that right-hand side, and G q̈ = -Ġ q̇, A among the rows of G.
class EquationsOfMotion {
 public:
  /// Traces them for the problem.
  explicit EquationsOfMotion(const TracedProblem& problem);

  /// q̈ at (q, v) under the control u at time t, n entries. Throws `Error` if L_vv is singular there, or with
  /// constraints (L_vv, Gᵀ; G, 0).
  [[nodiscard]] Eigen::VectorXd acceleration(const Eigen::Ref<const Eigen::VectorXd>& q,
                                             const Eigen::Ref<const Eigen::VectorXd>& v,
                                             const Eigen::Ref<const Eigen::VectorXd>& u, double t,
                                             const Eigen::Ref<const Eigen::VectorXd>& y = Eigen::VectorXd());

  /// λ of the constraints there, c entries: -Gᵀλ is the force that they need. Throws as `acceleration`.
  [[nodiscard]] Eigen::VectorXd multipliers(const MotionPoint& point, double t);

  /// The same as a system of first order: the first n entries of `rate` become v, the next n become q̈, then l become ẏ,
  /// at the state whose first entries are (q, v, y). Entries after these are left alone, so that an integrator may
  /// carry more along. Throws as `acceleration`.
  void write_rate(const std::vector<double>& state, const Eigen::Ref<const Eigen::VectorXd>& u, double t,
                  std::vector<double>& rate);

 private:
  /// q̈, then λ.
  [[nodiscard]] Eigen::VectorXd solved(const Eigen::Ref<const Eigen::VectorXd>& q,
                                       const Eigen::Ref<const Eigen::VectorXd>& v,
                                       const Eigen::Ref<const Eigen::VectorXd>& u, double t,
                                       const Eigen::Ref<const Eigen::VectorXd>& y);

  Eigen::Index n_;
  Eigen::Index l_;
  Eigen::Index c_;
  PointFunction function_;  // outputs: the right-hand side, ẏ, L_vv column by column, then -Ġ q̇ and G likewise
  Eigen::VectorXd values_;
};

}  // namespace dmocbench
