#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A hovercraft from rest at (1, 1) by (4, 3) at 25 s and (6, 0) at 50 s to (1, 1) at 60 s, with least ∫ |u|² dt. The
/// points are gates in time, |q - w| <= r while |t - t_w| < width: path constraints that act in short windows only.
class HoverWaypoints : public Problem {
 public:
  HoverWaypoints()
      : Problem({{.name = "r", .value = 0.05, .unit = "m", .meaning = "radius of the gates"},
                 {.name = "width", .value = 0.25, .unit = "s", .meaning = "half width of the gates in time"}}) {}
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_x", "u_y"}; }
  [[nodiscard]] Expression lagrangian(const State& s) const override { return 0.5 * s.v.squaredNorm(); }
  [[nodiscard]] ExpressionVector force(const ControlledState& s) const override { return s.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& s) const override { return s.u.squaredNorm(); }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& s) const override {
    return ExpressionVector{{gate(s, 25.0, 4.0, 3.0), gate(s, 50.0, 6.0, 0.0)}};
  }
  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::Vector2d(1.0, 1.0));
  }
  [[nodiscard]] BoundaryState final_state() const override { return BoundaryState::at_rest(Eigen::Vector2d(1.0, 1.0)); }
  [[nodiscard]] double horizon() const override { return 60.0; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds b = Problem::bounds();
    b.last.free_velocity(0).free_velocity(1);
    return b;
  }

 private:
  [[nodiscard]] Expression gate(const ControlledState& s, double t, double x, double y) const {
    const double k = 10.0 / parameter("width");
    const Expression open =
        1.0 / (1.0 + exp(-k * (s.t - t + parameter("width")))) / (1.0 + exp(k * (s.t - t - parameter("width"))));
    const Expression dx = s.q[0] - x;
    const Expression dy = s.q[1] - y;
    return parameter("r") * parameter("r") + 100.0 * (1.0 - open) - dx * dx - dy * dy;
  }
};

}  // namespace dmocbench
