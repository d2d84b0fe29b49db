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

  /// The momentum and its derivatives at a point.
  struct Values {
    Eigen::VectorXd momentum;          ///< p = L_v(q, v, t), n entries
    Eigen::MatrixXd mass;              ///< ∂p/∂v = L_vv, n × n
    Eigen::MatrixXd by_configuration;  ///< ∂p/∂q = L_vq at fixed v, n × n
    Eigen::MatrixXd by_first_order;    ///< ∂p/∂y = L_vy at fixed v, n × l
  };
  /// All of them.
  [[nodiscard]] Values at(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, const Eigen::VectorXd& y = {});

 private:
  /// A step of Newton's method.
  [[nodiscard]] std::optional<Eigen::VectorXd> velocity_correction(const Eigen::MatrixXd& mass,
                                                                   const Eigen::VectorXd& residual,
                                                                   const Eigen::VectorXd& v) const;

  Eigen::Index n_;
  Eigen::Index c_;
  PointFunction function_;  // outputs: L_v, then L_vv, L_vq and L_vy, then G, column by column
  Eigen::VectorXd values_;
};

}  // namespace dmocbench
