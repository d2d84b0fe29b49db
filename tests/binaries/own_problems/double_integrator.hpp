#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A mass of m kilograms, pushed from rest to rest over 1 m in 1 s: J = 6 m² with force u and cost ½u². A class of the
/// suite has this name too, with m = 1.
class DoubleIntegrator : public Problem {
 public:
  DoubleIntegrator() : Problem({{.name = "mass", .value = 2.0, .unit = "kg", .meaning = "that is pushed"}}) {}

  [[nodiscard]] std::string name() const override { return "heavy_mass"; }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"push"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * varying("mass") * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }
  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Zero(1));
  }
  [[nodiscard]] BoundaryState final_state() const override { return BoundaryState::at_rest(Eigen::VectorXd::Ones(1)); }
  [[nodiscard]] double horizon() const override { return 1.0; }
};

}  // namespace dmocbench
