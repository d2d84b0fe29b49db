#pragma once

#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// Chaplygin's sleigh: a rigid body on a blade, whose point of contact moves along the blade only.
///
/// The constraint -ẋ sin θ + ẏ cos θ = 0 is not the rate of any g(x, y, θ). So q = (s, θ), where ṡ is the velocity
/// along the blade, and y = (x, y), the position of the contact, with the rates ṡ (cos θ, sin θ). The centre of mass is
/// the distance a ahead of the contact, J is the inertia about it:
///   L = ½m ṡ² + ½(J + ma²) θ̇²,  f = (u₁ + ma θ̇², u₂ - ma ṡ θ̇),
/// where L is the kinetic energy on the constraint, and f contains the terms that the constraint adds to its
/// Euler-Lagrange equations. u₁ pushes along the blade, u₂ turns; C = ½|u|². From (0, 0, 0) at rest to (1, 1, π/2) at
/// rest in T = 2, s(T) free.
class ChaplyginSleigh : public Problem {
 public:
  ChaplyginSleigh()
      : Problem({
            {"mass", 1.0, "kg", "mass", 1e-3, 1e3},
            {"inertia", 0.3, "kg m^2", "inertia about the centre of mass", 1e-6, 1e3},
            {"offset", 0.4, "m", "distance a from the contact to the centre of mass", 0.0, 1e2},
            horizon_parameter(2.0),
        }) {}

  [[nodiscard]] std::string name() const override { return "chaplygin_sleigh"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "transfer of a sleigh on a blade to a new position and attitude, with least control effort",
            .title = "Chaplygin sleigh",
            .axis_units = {.state = "m or rad", .control = "N or N m", .momentum = "N s or N m s", .energy = "N m"},
            .source = "Chaplygin's sleigh in quasi-velocities, with data of this suite",
            .guess = "s and theta, x and y on straight lines, u = 0",
            .configuration_units = {"m", "rad"},
            .control_units = {"N", "N m"},
            .reference = with_default_parameters(
                *this, {.objective = 2.4338801165994428,
                        .digits = 15,
                        .certificate = "indirect shooting with 26 digits and a residual below 1e-22"}),
            .picture = [](const ControlledState& x) -> Picture {
              return {{"x", "m", x.y[0]},
                      {"y", "m", x.y[1]},
                      {"theta", "rad", x.q[1]},
                      {"push", "N", x.u[0]},
                      {"torque", "N m", x.u[1]}};
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"s", "theta"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"push", "torque"}; }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"x", "y"}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return ExpressionVector{{x.v[0] * cos(x.q[1]), x.v[0] * sin(x.q[1])}};
  }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression about_contact = varying("inertia") + varying("mass") * varying("offset") * varying("offset");
    return 0.5 * varying("mass") * x.v[0] * x.v[0] + 0.5 * about_contact * x.v[1] * x.v[1];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression turning = varying("mass") * varying("offset") * x.v[1];
    return ExpressionVector{{x.u[0] + turning * x.v[1], x.u[1] - turning * x.v[0]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

  [[nodiscard]] BoundaryState initial_state() const override { return at_rest(0.0, 0.0, {0.0, 0.0}); }
  [[nodiscard]] BoundaryState final_state() const override {
    return at_rest(std::numbers::sqrt2, 0.5 * std::numbers::pi, {1.0, 1.0});
  }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_configuration(0);
    return bounds;
  }

 private:
  static BoundaryState at_rest(double s, double theta, const Eigen::Vector2d& contact) {
    BoundaryState state = BoundaryState::at_rest(Eigen::Vector2d(s, theta));
    state.y = contact;
    return state;
  }
};

}  // namespace dmocbench
