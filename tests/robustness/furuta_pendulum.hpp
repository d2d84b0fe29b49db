#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// Swing-up of a pendulum (0.1 kg at 0.2 m) on the end of an arm (0.15 m, 0.002 kg m²) that a motor turns about the
/// vertical, q = (φ, α) with α from hanging. The torque is bounded to less than the 0.2 N m of the pendulum's own
/// weight, the horizon is free: C = 1 + 100 u².
class FurutaPendulum final : public SmallProblem {
 public:
  FurutaPendulum(double largest_torque, HorizonBounds horizon)
      : SmallProblem("furuta_pendulum", BoundaryState::at_rest(Eigen::Vector2d(0.0, 0.0)),
                     BoundaryState::at_rest(Eigen::Vector2d(0.0, std::numbers::pi)), std::min(1.0, horizon.upper), 1),
        largest_torque_(largest_torque),
        horizon_(horizon) {}

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression& arm_rate = x.v[0];
    const Expression& swing_rate = x.v[1];
    const Expression across = length * sin(x.q[1]) * arm_rate;
    const Expression along = arm * arm_rate + length * cos(x.q[1]) * swing_rate;
    const Expression upward = length * sin(x.q[1]) * swing_rate;
    return 0.5 * 0.002 * arm_rate * arm_rate + 0.5 * mass * (across * across + along * along + upward * upward) +
           mass * 9.81 * length * cos(x.q[1]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0], 0.0}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 1.0 + 100.0 * x.u[0] * x.u[0];
  }
  /// It swings back first.
  [[nodiscard]] MotionPoint guess(double t) const override {
    using std::numbers::pi;
    MotionPoint point = Problem::guess(t);
    constexpr double back = 2.0;  // rad
    const double rate = pi / horizon();
    point.q[1] -= back * std::sin(rate * t);
    point.v[1] -= back * rate * std::cos(rate * t);
    return point;
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.u = Bounds::all(1, -largest_torque_, largest_torque_);
    bounds.horizon = horizon_;
    return bounds;
  }

 private:
  static constexpr double mass = 0.1;    // kg
  static constexpr double length = 0.2;  // m
  static constexpr double arm = 0.15;    // m

  double largest_torque_;
  HorizonBounds horizon_;
};

}  // namespace dmocbench::tests
