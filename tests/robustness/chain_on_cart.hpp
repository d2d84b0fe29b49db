#pragma once

#include <numbers>

#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// A chain of light rods (0.4 m) with point masses (0.2 kg) at their ends on a cart (1 kg) that is pushed by u; C = u².
///
/// q = (x, θ_1 .. θ_n), θ from upright. Standing still it falls apart by e^(λT) with λ above 10/s for three rods: a
/// replay of the whole horizon cannot judge it.
class ChainOnCart final : public SmallProblem {
 public:
  /// The chain stands at both ends and the cart moves by one metre.
  static ChainOnCart shifted(Eigen::Index links) { return {"chain_shifted", links, 0.0, 3.0}; }
  /// The chain hangs first and stands at last, where the cart was.
  static ChainOnCart swung_up(Eigen::Index links) { return {"chain_swung_up", links, std::numbers::pi, 2.0}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    Expression kinetic = 0.5 * x.v[0] * x.v[0];
    Expression height = 0.0;
    Expression across_rate = x.v[0];
    Expression upward_rate = 0.0;
    Expression joint_height = 0.0;
    for (Eigen::Index i = 1; i < x.q.size(); ++i) {
      across_rate += rod * cos(x.q[i]) * x.v[i];
      upward_rate -= rod * sin(x.q[i]) * x.v[i];
      joint_height += rod * cos(x.q[i]);
      kinetic += 0.5 * mass * (across_rate * across_rate + upward_rate * upward_rate);
      height += joint_height;
    }
    return kinetic - mass * 9.81 * height;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    ExpressionVector f = ExpressionVector::Constant(x.q.size(), Expression(0.0));
    f[0] = x.u[0];
    return f;
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }
  [[nodiscard]] double cost_scale() const override { return 1e-2; }

 private:
  static constexpr double rod = 0.4;   // m
  static constexpr double mass = 0.2;  // kg

  ChainOnCart(const std::string& name, Eigen::Index links, double angle, double horizon)
      : SmallProblem(name, standing(links, 0.0, angle), standing(links, angle == 0.0 ? 1.0 : 0.0, 0.0), horizon, 1) {}

  static BoundaryState standing(Eigen::Index links, double position, double angle) {
    Eigen::VectorXd q = Eigen::VectorXd::Constant(links + 1, angle);
    q[0] = position;
    return BoundaryState::at_rest(q);
  }
};

}  // namespace dmocbench::tests
