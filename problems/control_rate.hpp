#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A particle is moved by a force whose rate is bounded, the example `control_rate` of PSOPT.
///
/// q, L = ½q̇², f = y, ẏ = u with |u| <= 4, C = y²; from 0 to 1 at rest in T = 2, without force at the start; the force
/// at the end is free.
///
/// Without the bound y would jump to its largest value at the start. With it y = 4t up to t = 3/8, then
/// 3/2 - 348/169 (t - 3/8), which meets q̇(2) = 0 and q(2) = 1; the least cost is 24/13.
class ControlRate final : public Problem {
 public:
  [[nodiscard]] std::string name() const override { return "control_rate"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "double integrator whose force has a bounded rate, with least effort",
            .title = "Double integrator with bounded rate",
            .source = "Becerra: PSOPT Optimal Control Solver User Manual, example control_rate",
            .guess = "q and the force on straight lines between the ends, u = 0",
            .reference = ReferenceOptimum{.objective = 24.0 / 13.0,
                                          .digits = 16,
                                          .certificate = "closed form",
                                          .published = {{1.846315, "PSOPT, example control_rate"}},
                                          .remark = "the published value is specific to its grid"}};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"q"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"force_rate"}; }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"force"}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override { return x.u; }

  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.y; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.y[0] * x.y[0]; }

  [[nodiscard]] BoundaryState initial_state() const override { return at_rest(0.0); }
  [[nodiscard]] BoundaryState final_state() const override { return at_rest(1.0); }
  [[nodiscard]] double horizon() const override { return 2.0; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_first_order(0);
    bounds.u = Bounds::all(1, -4.0, 4.0);
    return bounds;
  }

 private:
  static BoundaryState at_rest(double q) {
    return {.q = Eigen::VectorXd::Constant(1, q), .v = Eigen::VectorXd::Zero(1), .y = Eigen::VectorXd::Zero(1)};
  }
};

}  // namespace dmocbench
