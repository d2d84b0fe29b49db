#pragma once

#include <cmath>
#include <numbers>

#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// Swing-up of a pendulum (1 kg, 1 m) in Cartesian coordinates, a torque at its pivot, C = u². The force of the rod is
/// solved for by hand,
///   λ = (m g y - m |v|²)/|q|², force λ q,
/// so that q·q̈ = -|v|²; one entry of the final q and of the final v is left free.
class CartesianPendulum : public SmallProblem {
 public:
  CartesianPendulum() : CartesianPendulum("cartesian_pendulum", 1) {}

  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v.dot(x.v) - 9.81 * x.q[1]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return pulled(x, (9.81 * x.q[1] - x.v.dot(x.v)) / x.q.dot(x.q));
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }
  [[nodiscard]] double cost_scale() const override { return 1e-1; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_configuration(1);
    bounds.last.free_velocity(1);
    bounds.last.q.lower[1] = 0.0;  // else it could stay where it hangs
    return bounds;
  }
  /// On the circle, at a constant rate.
  [[nodiscard]] MotionPoint guess(double t) const override {
    const double rate = std::numbers::pi / horizon();
    const double angle = rate * t;
    return {.q = Eigen::Vector2d(std::sin(angle), -std::cos(angle)),
            .v = rate * Eigen::Vector2d(std::cos(angle), std::sin(angle)),
            .u = Eigen::VectorXd::Zero(control_size())};
  }

 protected:
  CartesianPendulum(const std::string& name, Eigen::Index controls)
      : SmallProblem(name, BoundaryState::at_rest(Eigen::Vector2d(0.0, -1.0)),
                     BoundaryState::at_rest(Eigen::Vector2d(0.0, 1.0)), 2.0, controls) {}

  static ExpressionVector pulled(const ControlledState& x, const Expression& rod) {
    const Expression turning = x.u[0] / x.q.dot(x.q);
    return ExpressionVector{{rod * x.q[0] - turning * x.q[1], rod * x.q[1] + turning * x.q[0]}};
  }
};

/// What a user would try first: the rod's force as a control, its length as two inequalities, h >= 0 and -h >= 0. Their
/// gradients are dependent everywhere, and stages that keep the length say nothing of the motion between them.
class PendulumOnInequalities final : public CartesianPendulum {
 public:
  PendulumOnInequalities() : CartesianPendulum("pendulum_on_inequalities", 2) {}
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return pulled(x, x.u[1]); }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    const Expression stretch = x.q.dot(x.q) - 1.0;
    return ExpressionVector{{stretch, -stretch}};
  }
};

}  // namespace dmocbench::tests
