#pragma once

#include <Eigen/Core>

#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

/// The Legendre transform 𝔽L : (q, v) ↦ (q, p = L_v(q, v)) and its inverse, on numbers.
class LegendreTransform {
 public:
  /// Traces it for the problem.
  explicit LegendreTransform(const TracedProblem& problem);

  /// p = L_v(q, v, t), n entries.
  [[nodiscard]] Eigen::VectorXd momentum(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t);

  /// The v with L_v(q, v, t) = p, by Newton's method from v = `start` (one step if L is quadratic in v).
  /// Throws `Error` if L_vv is singular there or the iteration does not converge.
  [[nodiscard]] Eigen::VectorXd velocity(const Eigen::VectorXd& q, const Eigen::VectorXd& p, double t,
                                         const Eigen::VectorXd& start);

  /// L_vv(q, v, t), n × n.
  [[nodiscard]] Eigen::MatrixXd mass(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t);

  /// ∂p/∂q = L_vq(q, v, t), n × n, at fixed v.
  [[nodiscard]] Eigen::MatrixXd momentum_by_configuration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t);

 private:
  void evaluate(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t);

  Eigen::Index n_;
  PointFunction function_;  // outputs: L_v, then L_vv, then L_vq, column by column
  Eigen::VectorXd values_;
};

}  // namespace dmocbench
