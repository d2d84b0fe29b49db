#pragma once

#include <cmath>
#include <numbers>

#include "problems/circle_to_circle.hpp"

namespace dmocbench {

/// Low thrust transfer of a satellite between two circular orbits, section 4.2.1 of the paper (orb_trans).
///
/// q = (r, φ), L = ½(ṙ² + r²φ̇²) + 1/r, f = (0, r u), C = u², data and units of `CircleToCircle`. φ is unwrapped:
/// φ(T) = 2πd after d revolutions.
class OrbitalTransfer final : public CircleToCircle {
 public:
  [[nodiscard]] std::string name() const override { return "orbital_transfer"; }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = CircleToCircle::card();
    card.description = "low thrust transfer of a satellite between two circular orbits, least control effort";
    return card;
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"r", "phi"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression& r = x.q[0];
    const Expression& r_dot = x.v[0];
    const Expression& phi_dot = x.v[1];
    return 0.5 * (r_dot * r_dot + r * r * phi_dot * phi_dot) + 1.0 / r;
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{0.0, x.q[0] * x.u[0]}};
  }

  [[nodiscard]] BoundaryState initial_state() const override {
    return {.q = Eigen::Vector2d(1.0, 0.0), .v = Eigen::Vector2d(0.0, 1.0)};
  }

  [[nodiscard]] BoundaryState final_state() const override {
    const double rho = radius_ratio();
    return {.q = Eigen::Vector2d(rho, 2.0 * std::numbers::pi * parameter("revolutions")),
            .v = Eigen::Vector2d(0.0, std::pow(rho, -1.5))};
  }

  /// Rotations: ξ = (0, 1), the momentum is the angular momentum.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{0.0, 1.0}};
  }

  [[nodiscard]] std::vector<PictureQuantity> picture(const ControlledState& x) const override {
    const Expression radius = initial_radius() * x.q[0];
    const Expression thrust = acceleration_scale() * x.u[0];
    return {{"x", "km", radius * cos(x.q[1])},
            {"y", "km", radius * sin(x.q[1])},
            {"altitude", "km", radius - parameter("earth_radius")},
            {"thrust", "m/s^2", thrust},
            {"thrust_x", "m/s^2", -thrust * sin(x.q[1])},
            {"thrust_y", "m/s^2", thrust * cos(x.q[1])}};
  }
};

}  // namespace dmocbench
