#pragma once

#include <Eigen/Core>

#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

/// First derivatives of C and of F = L_q + f at points of a motion, with L_vv and L_vq: they turn costates into
/// multipliers and back.
class PointDerivatives {
 public:
  /// Traces all of them.
  explicit PointDerivatives(const TracedProblem& problem)
      : n_(problem.configuration_size()),
        function_(
            n_, problem.control_size(),
            [&](const ControlledState& x) {
              const TracedProblem::Values values = problem.at(x);
              ExpressionVector outputs(2 * n_ + 4 * n_ * n_);
              outputs << gradient(values.running_cost, x.q), gradient(values.running_cost, x.v),
                  jacobian(values.generalised_force, x.q).reshaped(),
                  jacobian(values.generalised_force, x.v).reshaped(), values.mass.reshaped(),
                  values.momentum_by_configuration.reshaped();
              return outputs;
            },
            problem.first_order_size()),
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

 private:
  [[nodiscard]] Eigen::MatrixXd matrix(Eigen::Index which) const {
    return values_.segment(2 * n_ + which * n_ * n_, n_ * n_).reshaped(n_, n_);
  }

  Eigen::Index n_;
  PointFunction function_;
  Eigen::VectorXd values_;
};

}  // namespace dmocbench
