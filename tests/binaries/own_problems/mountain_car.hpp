#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A weak car leaves a valley in the shortest time: q̈ = 0.001 u - 0.0025 cos 3q, |u| <= 1, from rest at -0.5 to 0.5
/// with v >= 0; -1.2 <= q <= 0.5, |v| <= 0.07. The least possible time is 102.36754 s, by shooting between the
/// switches.
class MountainCar : public Problem {
 public:
  MountainCar()
      : Problem({{.name = "t_guess", .value = 100.0, .unit = "s", .meaning = "guess of the horizon"},
                 {.name = "swings", .value = 0.0, .unit = "", .meaning = "1: a guess that swings back first"}}) {}
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v[0] * x.v[0] - 0.0025 / 3.0 * sin(3.0 * x.q[0]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{0.001 * x.u[0]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState&) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override { return last.t; }
  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Constant(1, -0.5));
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Constant(1, 0.5));
  }
  [[nodiscard]] double horizon() const override { return parameter("t_guess"); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds b = Problem::bounds();
    b.last.v = Bounds::all(1, 0.0, 0.07);
    b.q = Bounds::all(1, -1.2, 0.5);
    b.v = Bounds::all(1, -0.07, 0.07);
    b.u = Bounds::all(1, -1.0, 1.0);
    b.horizon = {1.0, 500.0};
    return b;
  }
};

}  // namespace dmocbench
