#pragma once

#include <numbers>

#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// Swing-up of two rods (1 kg at 0.5 m each) of which only the shoulder has a motor; both joints have viscous friction.
/// q = (θ_1, θ_2), orientations from hanging; C = u².
class DampedPendubot final : public SmallProblem {
 public:
  DampedPendubot()
      : SmallProblem("damped_pendubot", BoundaryState::at_rest(Eigen::Vector2d::Zero()),
                     BoundaryState::at_rest(Eigen::Vector2d(std::numbers::pi, std::numbers::pi)), 2.0, 1) {}

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression kinetic =
        length * length * (x.v[0] * x.v[0] + 0.5 * x.v[1] * x.v[1] + cos(x.q[0] - x.q[1]) * x.v[0] * x.v[1]);
    return kinetic + 9.81 * length * (2.0 * cos(x.q[0]) + cos(x.q[1]));
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression elbow = friction * (x.v[1] - x.v[0]);
    return ExpressionVector{{x.u[0] - friction * x.v[0] + elbow, -elbow}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }
  [[nodiscard]] double cost_scale() const override { return 1e-2; }

 private:
  static constexpr double length = 0.5;    // m
  static constexpr double friction = 0.1;  // N m s
};

}  // namespace dmocbench::tests
