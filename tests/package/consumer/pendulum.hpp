// A problem of one's own: a pendulum swings up in 4 s with least torque.
#pragma once

#include <numbers>

#include <dmocbench/problem.hpp>

using namespace dmocbench;

struct Pendulum : Problem {  // θ = 0 hangs down; mass 1 kg, length 1 m
  std::string name() const override { return "pendulum"; }
  ProblemCard card() const override { return {.description = "a pendulum swings up with least torque"}; }
  std::vector<std::string> configuration_names() const override { return {"theta"}; }
  std::vector<std::string> control_names() const override { return {"torque"}; }
  Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0] + 9.81 * cos(x.q[0]); }
  ExpressionVector force(const ControlledState& x) const override { return x.u; }
  Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }
  BoundaryState initial_state() const override { return at_rest(0.0); }
  BoundaryState final_state() const override { return at_rest(std::numbers::pi); }
  ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.u = Bounds::all(1, -6.0, 6.0);
    return bounds;
  }
  double horizon() const override { return 4.0; }
  static BoundaryState at_rest(double theta) { return BoundaryState::at_rest(Eigen::VectorXd::Constant(1, theta)); }
};
