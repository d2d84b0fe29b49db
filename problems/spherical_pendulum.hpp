#pragma once

#include <cmath>
#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// A spherical pendulum is carried from one steady cone to a wider one while it goes around the vertical.
///
/// q = (θ, φ), the angle from below and the azimuth; L = ½ml²(θ̇² + sin²θ φ̇²) + mgl cos θ, f = u, C = ½|u|². On the
/// cone θ the pendulum goes around at the rate sqrt(g/(l cos θ)) without any torque: both ends are such motions, from
/// π/4 to π/3 during d revolutions. The coordinates are singular at θ = 0, far below both cones. Data: m = 1, l = 1,
/// T = 1.5.
class SphericalPendulum : public Problem {
 public:
  SphericalPendulum()
      : Problem({
            {"mass", 1.0, "kg", "mass of the bob", 1e-3, 1e3},
            {"length", 1.0, "m", "length of the rod", 1e-3, 1e3},
            gravity_parameter(1e-3),
            {"initial_cone", std::numbers::pi / 4.0, "rad", "angle of the first cone, 0 downwards", 0.1, 1.5},
            {"target_cone", std::numbers::pi / 3.0, "rad", "angle of the last cone, 0 downwards", 0.1, 1.5},
            {"revolutions", 1.0, "", "number d of revolutions", 0.0, 100.0, true},
            horizon_parameter(1.5),
        }) {}

  [[nodiscard]] std::string name() const override { return "spherical_pendulum"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {
        .description = "transfer of a spherical pendulum from a steady cone to a wider cone, with least control effort",
        .title = "Spherical pendulum",
        .axis_units = {.state = "rad", .control = "N m", .momentum = "N m s", .cost = "N² m² s", .energy = "N m"},
        .source =
            "stated for this library: a mass matrix that depends on the configuration, a symmetry, both ends steady",
        .configuration_units = {"rad", "rad"},
        .control_units = {"N m", "N m"},
        .reference = with_default_parameters(
            *this, {.objective = 0.91134694658953, .digits = 13, .certificate = by_indirect_method(13)}),
        .picture = [this](const ControlledState& x) -> Picture {
          const double l = parameter("length");
          return {{"bob_x", "m", l * sin(x.q[0]) * cos(x.q[1])},
                  {"bob_y", "m", l * sin(x.q[0]) * sin(x.q[1])},
                  {"bob_z", "m", -l * cos(x.q[0])},
                  {"u_theta", "N m", x.u[0]},
                  {"u_phi", "N m", x.u[1]}};
        }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"theta", "phi"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_theta", "u_phi"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression m = varying("mass");
    const Expression l = varying("length");
    const Expression sine = sin(x.q[0]);
    return 0.5 * m * l * l * (x.v[0] * x.v[0] + sine * sine * x.v[1] * x.v[1]) +
           m * varying("gravity") * l * cos(x.q[0]);
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }

  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

  [[nodiscard]] BoundaryState initial_state() const override { return on_cone(parameter("initial_cone"), 0.0); }
  [[nodiscard]] BoundaryState final_state() const override {
    return on_cone(parameter("target_cone"), 2.0 * std::numbers::pi * parameter("revolutions"));
  }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }

  /// Rotations about the vertical: ξ = (0, 1).
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{0.0, 1.0}};
  }

 private:
  /// The steady motion on a cone.
  [[nodiscard]] BoundaryState on_cone(double theta, double phi) const {
    const double rate = std::sqrt(parameter("gravity") / (parameter("length") * std::cos(theta)));
    return {.q = Eigen::Vector2d(theta, phi), .v = Eigen::Vector2d(0.0, rate)};
  }
};

}  // namespace dmocbench
