#pragma once

#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// L_vv = [1 1; 1 1] has no empty row, but no inverse either.
class SingularMass final : public SmallProblem {
 public:
  SingularMass()
      : SmallProblem("singular_mass", {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()},
                     {Eigen::Vector2d::Ones(), Eigen::Vector2d::Zero()}, 1.0, 2) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression sum = x.v[0] + x.v[1];
    return 0.5 * sum * sum;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }
};

}  // namespace dmocbench::tests
