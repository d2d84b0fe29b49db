#pragma once

#include <optional>

#include <Eigen/Core>

#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

/// The Legendre transform 𝔽L : (q, v) ↦ (q, p = L_v(q, v)) and its inverse, on numbers.
class LegendreTransform {
 public:
  /// Traces it for the problem.
  explicit LegendreTransform(const TracedProblem& problem);

  // First-order states y are the last argument of all functions; without an entry where the problem has none.

  /// p = L_v(q, v, t), n entries.
  [[nodiscard]] Eigen::VectorXd momentum(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                         const Eigen::VectorXd& y = {});

  /// The v with L_v(q, v, t) = p, by Newton's method from v = `start` (one step if L is quadratic in v). With
  /// constraints the v with G v = 0 and L_v(q, v, t) = p - Gᵀμ for some μ: the velocity of the projected momentum.
  /// Throws `Error` if L_vv is singular there, or (L_vv, Gᵀ; G, 0), or the iteration does not converge.
  [[nodiscard]] Eigen::VectorXd velocity(const Eigen::VectorXd& q, const Eigen::VectorXd& p, double t,
                                         const Eigen::VectorXd& start, const Eigen::VectorXd& y = {});

  /// L_vv(q, v, t), n × n.
  [[nodiscard]] Eigen::MatrixXd mass(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                     const Eigen::VectorXd& y = {});

  /// ∂p/∂q = L_vq(q, v, t), n × n, at fixed v.
  [[nodiscard]] Eigen::MatrixXd momentum_by_configuration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                                          const Eigen::VectorXd& y = {});

  /// ∂p/∂y = L_vy(q, v, t), n × l, at fixed v.
  [[nodiscard]] Eigen::MatrixXd momentum_by_first_order(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                                        const Eigen::VectorXd& y);

 private:
  /// A step of Newton's method.
  [[nodiscard]] std::optional<Eigen::VectorXd> velocity_correction(const Eigen::MatrixXd& mass,
                                                                   const Eigen::VectorXd& residual,
                                                                   const Eigen::VectorXd& v) const;
  void evaluate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, const Eigen::VectorXd& y);

  Eigen::Index n_;
  Eigen::Index c_;
  PointFunction function_;  // outputs: L_v, then L_vv, L_vq and L_vy, then G, column by column
  Eigen::VectorXd values_;
};

}  // namespace dmocbench
