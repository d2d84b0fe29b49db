#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A unit mass from rest to rest over 1 m in 1 s: L = ½v², f = u, C = ½u², while -5 <= u + v <= 5 and u <= 4.5. Without
/// bounds u = 6 - 12t: all three act.
class PushedInABand final : public Problem {
 public:
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"place"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"push"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0] + x.v[0], x.u[0]}};
  }
  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Zero(1));
  }
  [[nodiscard]] BoundaryState final_state() const override { return BoundaryState::at_rest(Eigen::VectorXd::Ones(1)); }
  [[nodiscard]] double horizon() const override { return 1.0; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.path = Bounds::none(2);
    bounds.path.lower[0] = -5.0;
    bounds.path.upper << 5.0, 4.5;
    return bounds;
  }
};

}  // namespace dmocbench
