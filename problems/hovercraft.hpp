#pragma once

#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// A hovercraft with two forces at its stern glides to another place and attitude.
///
/// q = (x, y, θ), L = ½m(ẋ² + ẏ²) + ½Jθ̇², f = (R(θ)(u₁, u₂), -r u₂): u₁ pushes along the axis, u₂ across it at the
/// distance r behind the centre, so there are fewer controls than degrees of freedom. C = ½|u|², from (0, 0, 0) at rest
/// to (1, 1, π/2) at rest. Data: m = 1, J = 0.05, r = 0.1, T = 5.
class Hovercraft : public Problem {
 public:
  Hovercraft()
      : Problem({
            {"mass", 1.0, "kg", "mass", 1e-3, 1e3},
            {"inertia", 0.05, "kg m^2", "inertia about the centre", 1e-6, 1e3},
            {"lever", 0.1, "m", "distance r of the forces behind the centre", 1e-3, 1e2},
            horizon_parameter(5.0),
        }) {}

  [[nodiscard]] std::string name() const override { return "hovercraft"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {
        .description = "transfer of an underactuated hovercraft to a new position and attitude, with least effort",
        .title = "Hovercraft",
        .axis_units = {.state = "m or rad", .control = "N", .momentum = "N m s", .cost = "N² s", .energy = "N m"},
        .source =
            "the hovercraft of Junge, Marsden, Ober-Bloebaum: Discrete mechanics and optimal control, IFAC 2005, with "
            "data of this suite",
        .configuration_units = {"m", "m", "rad"},
        .control_units = {"N", "N"},
        .reference =
            with_default_parameters(*this, {.objective = 0.8719293256585,
                                            .digits = 12,
                                            .certificate = by_indirect_method(12),
                                            .remark = "another minimum costs 1.22519; of 100 perturbed starts, 41 "
                                                      "converge to the reference minimum and 59 to this one"}),
        .picture = [this](const ControlledState& x) -> Picture {
          const double r = parameter("lever");
          return {{"centre_x", "m", x.q[0]},
                  {"centre_y", "m", x.q[1]},
                  {"stern_x", "m", x.q[0] - r * cos(x.q[2])},
                  {"stern_y", "m", x.q[1] - r * sin(x.q[2])},
                  {"u_1", "N", x.u[0]},
                  {"u_2", "N", x.u[1]}};
        }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y", "theta"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_1", "u_2"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * varying("mass") * (x.v[0] * x.v[0] + x.v[1] * x.v[1]) + 0.5 * varying("inertia") * x.v[2] * x.v[2];
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression cosine = cos(x.q[2]);
    const Expression sine = sin(x.q[2]);
    return ExpressionVector{
        {cosine * x.u[0] - sine * x.u[1], sine * x.u[0] + cosine * x.u[1], -varying("lever") * x.u[1]}};
  }

  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

  [[nodiscard]] BoundaryState initial_state() const override { return BoundaryState::at_rest(Eigen::Vector3d::Zero()); }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::Vector3d(1.0, 1.0, std::numbers::pi / 2.0));
  }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }

  /// Rotations of the plane about the origin: ξ = (-y, x, 1).
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    return ExpressionVector{{-q[1], q[0], 1.0}};
  }
};

}  // namespace dmocbench
