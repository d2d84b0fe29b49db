#pragma once

#include "problems/redundant_statement.hpp"
#include "problems/spherical_pendulum.hpp"

namespace dmocbench {

/// `spherical_pendulum` in Cartesian coordinates: q = (x, y, z) is the place of the bob, z upwards, with the constraint
/// |q|² - l² = 0;
///   L = ½m|q̇|² - mgz,  f = u_1 ∇θ + u_2 ∇φ,  C = ½|u|².
/// The torques do work on the rates of the angles θ from below and φ around the vertical, also where |q| is not l.
class SphericalPendulumCartesian : public RedundantStatement<SphericalPendulum> {
 public:
  [[nodiscard]] std::string name() const override { return "spherical_pendulum_cartesian"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    const ProblemCard of_angles = minimal().card();
    return {.description = "transfer of a spherical pendulum, a point on a sphere, from a steady cone to a wider cone",
            .title = "Spherical pendulum (Cartesian)",
            .axis_units = {.state = "m", .control = "N m", .momentum = "N s", .cost = "N² m² s", .energy = "N m"},
            .source = "spherical_pendulum in Cartesian coordinates with one constraint",
            .guess = "as in spherical_pendulum",
            .reference = of_angles.reference,
            .picture = [](const ControlledState& x) -> Picture {
              return {{"bob_x", "m", x.q[0]},
                      {"bob_y", "m", x.q[1]},
                      {"bob_z", "m", x.q[2]},
                      {"u_theta", "N m", x.u[0]},
                      {"u_phi", "N m", x.u[1]}};
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y", "z"}; }

  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    const Expression l = varying("length");
    return ExpressionVector{{q.dot(q) - l * l}};
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression m = varying("mass");
    return 0.5 * m * x.v.dot(x.v) - m * varying("gravity") * x.q[2];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression squared = x.q[0] * x.q[0] + x.q[1] * x.q[1];
    const Expression radius = sqrt(squared);
    const Expression of_theta = x.u[0] / (squared + x.q[2] * x.q[2]);
    const Expression of_phi = x.u[1] / squared;
    return ExpressionVector{{-of_theta * x.q[2] * x.q[0] / radius - of_phi * x.q[1],
                             -of_theta * x.q[2] * x.q[1] / radius + of_phi * x.q[0], of_theta * radius}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

  /// Rotations about the vertical.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    return ExpressionVector{{-q[1], q[0], 0.0}};
  }

  [[nodiscard]] ExpressionVector embedding(const ExpressionVector& theta) const override {
    const Expression l = parameter("length");
    return ExpressionVector{{l * sin(theta[0]) * cos(theta[1]), l * sin(theta[0]) * sin(theta[1]), -l * cos(theta[0])}};
  }
};

}  // namespace dmocbench
