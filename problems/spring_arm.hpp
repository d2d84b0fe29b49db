#pragma once

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// An arm with a spring in its joint, whose stiffness is chosen along with the motion.
///
/// q is the angle, L = ½q̇² - ½k q², f = u - d q̇, C = ½u²; from -1 to 1 at rest in T = 1 s, d = 0.5 N m s the damping,
/// inertia 1 kg m². Without damping k = π² would need no torque at all: the arm would swing through by itself.
class SpringArm final : public Problem {
 public:
  SpringArm()
      : Problem({{"stiffness", 5.0, "N m", "stiffness k of the spring", 0.0, 100.0, false, true},
                 {"damping", 0.5, "N m s", "damping d of the joint", 0.0, 10.0},
                 horizon_parameter(1.0)}) {}

  [[nodiscard]] std::string name() const override { return "spring_arm"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "transfer of an arm with a spring of unknown stiffness from rest to rest, with least torque",
            .title = "Arm with a spring",
            .axis_units = {.state = "rad", .control = "N m", .momentum = "N m s", .cost = "N² m² s", .energy = "N m"},
            .source = "an arm with parallel elasticity, stated for this library"};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"angle"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"torque"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v[0] * x.v[0] - 0.5 * varying("stiffness") * x.q[0] * x.q[0];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0] - varying("damping") * x.v[0]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }

  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Constant(1, -1.0));
  }
  [[nodiscard]] BoundaryState final_state() const override { return BoundaryState::at_rest(Eigen::VectorXd::Ones(1)); }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }
};

}  // namespace dmocbench
