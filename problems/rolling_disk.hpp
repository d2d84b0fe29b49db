#pragma once

#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// An upright disk that rolls on a plane without slipping is parked ahead and aside with the least effort.
///
/// q = (x, y, θ, φ): the point of contact, the heading and the angle of rolling. The disk is homogeneous, with mass m
/// and radius R. Velocity constraints ẋ = R φ̇ cos θ, ẏ = R φ̇ sin θ;
///   L = ½m(ẋ² + ẏ²) + ⅛mR² θ̇² + ¼mR² φ̇²,  f = (0, 0, u₁, u₂),  C = ½|u|².
/// u₁ steers, u₂ drives. From (0, 0) to (1, 1), both at rest with the heading 0, in T = 2; φ(T) is free.
class RollingDisk final : public Problem {
 public:
  RollingDisk()
      : Problem({{"mass", 1.0, "kg", "mass", 1e-3, 1e3},
                 {"radius", 0.5, "m", "radius", 1e-3, 1e2},
                 horizon_parameter(2.0)}) {}

  [[nodiscard]] std::string name() const override { return "rolling_disk"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "upright disk that rolls to a position ahead and to the side, with least control effort",
            .title = "Rolling disk",
            .axis_units = {.state = "m or rad", .control = "N m", .momentum = "N s or N m s", .energy = "N m"},
            .source = "the vertical rolling disk of Bloch: Nonholonomic Mechanics and Control, with data of this suite",
            .guess = "straight lines, u = 0",
            .configuration_units = {"m", "m", "rad", "rad"},
            .control_units = {"N m", "N m"},
            .reference = with_default_parameters(
                *this, {.objective = 0.99079776270619299,
                        .digits = 15,
                        .certificate = "indirect shooting with 26 digits and a residual below 1e-24"})};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y", "theta", "phi"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"steering", "drive"}; }

  [[nodiscard]] ExpressionVector velocity_constraints(const ExpressionVector& q,
                                                      const ExpressionVector& v) const override {
    const Expression rolled = varying("radius") * v[3];
    return ExpressionVector{{v[0] - rolled * cos(q[2]), v[1] - rolled * sin(q[2])}};
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression turning = x.v[2] * x.v[2] + 2.0 * x.v[3] * x.v[3];
    const Expression radius = varying("radius");
    return 0.5 * varying("mass") * (x.v[0] * x.v[0] + x.v[1] * x.v[1] + 0.25 * radius * radius * turning);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{0.0, 0.0, x.u[0], x.u[1]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

  [[nodiscard]] BoundaryState initial_state() const override { return BoundaryState::at_rest(Eigen::Vector4d::Zero()); }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::Vector4d(1.0, 1.0, 0.0, std::numbers::sqrt2 / parameter("radius")));
  }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_configuration(3);
    return bounds;
  }

  /// Rotations about the origin.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    return ExpressionVector{{-q[1], q[0], 1.0, 0.0}};
  }
};

}  // namespace dmocbench
