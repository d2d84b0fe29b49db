#pragma once

#include <Eigen/Core>

#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

/// First derivatives of C, of F = L_q + f and of g at points of a motion, with L_vv and L_vq: they turn costates into
/// multipliers and back. C is less the integrals at their prices, where there are any.
class PointDerivatives {
 public:
  /// Traces all of them; `prices` has an entry per integral, or none.
  explicit PointDerivatives(const TracedProblem& problem, const Eigen::VectorXd& prices = {})
      : n_(problem.configuration_size()),
        l_(problem.first_order_size()),
        function_(problem,
                  [&](const ControlledState& x) {
                    const TracedProblem::Values values = problem.at(x);
                    Expression cost = values.running_cost;
                    for (Eigen::Index i = 0; i < prices.size(); ++i)
                      cost -= Expression(prices[i]) * values.integrands[i];
                    const ExpressionVector& rates = values.first_order_rates;
                    ExpressionVector outputs(2 * n_ + 4 * n_ * n_ + l_ * (1 + 4 * n_ + l_));
                    outputs << gradient(cost, x.q), gradient(cost, x.v),
                        jacobian(values.generalised_force, x.q).reshaped(),
                        jacobian(values.generalised_force, x.v).reshaped(), values.mass.reshaped(),
                        values.momentum_by_configuration.reshaped(), gradient(cost, x.y),
                        jacobian(values.generalised_force, x.y).reshaped(), jacobian(rates, x.q).reshaped(),
                        jacobian(rates, x.v).reshaped(), values.momentum_by_first_order.reshaped(),
                        jacobian(rates, x.y).reshaped();
                    return outputs;
                  }),
        values_(function_.output_count()) {}

  /// Everything below refers to the point evaluated last.
  void evaluate(const MotionPoint& point, double t) { function_.evaluate(point, t, values_); }

  /// C_q, n entries.
  [[nodiscard]] Eigen::VectorXd cost_by_configuration() const { return values_.head(n_); }
  /// C_v, n entries.
  [[nodiscard]] Eigen::VectorXd cost_by_velocity() const { return values_.segment(n_, n_); }
  [[nodiscard]] Eigen::MatrixXd force_by_configuration() const { return matrix(0); }  ///< F_q, n × n.
  [[nodiscard]] Eigen::MatrixXd force_by_velocity() const { return matrix(1); }       ///< F_v, n × n.
  /// L_vv, n × n.
  [[nodiscard]] Eigen::MatrixXd mass() const { return matrix(2); }
  /// L_vq, n × n.
  [[nodiscard]] Eigen::MatrixXd momentum_by_configuration() const { return matrix(3); }
  // Of first-order states; without entries where there are none.
  /// C_y, l entries.
  [[nodiscard]] Eigen::VectorXd cost_by_first_order() const { return values_.segment(first_order(0), l_); }
  [[nodiscard]] Eigen::MatrixXd force_by_first_order() const { return first_order_matrix(0, n_, l_); }  ///< F_y, n × l.
  [[nodiscard]] Eigen::MatrixXd rates_by_configuration() const {
    return first_order_matrix(1, l_, n_);
  }                                                                                                  ///< g_q, l × n.
  [[nodiscard]] Eigen::MatrixXd rates_by_velocity() const { return first_order_matrix(2, l_, n_); }  ///< g_v, l × n.
  /// L_vy, n × l.
  [[nodiscard]] Eigen::MatrixXd momentum_by_first_order() const { return first_order_matrix(3, n_, l_); }
  /// g_y, l × l.
  [[nodiscard]] Eigen::MatrixXd rates_by_first_order() const { return first_order_matrix(4, l_, l_); }

 private:
  [[nodiscard]] Eigen::MatrixXd matrix(Eigen::Index which) const {
    return values_.segment(2 * n_ + which * n_ * n_, n_ * n_).reshaped(n_, n_);
  }
  /// Where C_y and the matrices of n l entries after it begin.
  [[nodiscard]] Eigen::Index first_order(Eigen::Index which) const {
    return 2 * n_ + 4 * n_ * n_ + (which == 0 ? 0 : l_ + (which - 1) * n_ * l_);
  }
  [[nodiscard]] Eigen::MatrixXd first_order_matrix(Eigen::Index which, Eigen::Index rows, Eigen::Index columns) const {
    return values_.segment(first_order(which + 1), rows * columns).reshaped(rows, columns);
  }

  Eigen::Index n_;
  Eigen::Index l_;
  PointFunction function_;
  Eigen::VectorXd values_;
};

}  // namespace dmocbench
