#pragma once

#include <cmath>
#include <numbers>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Low thrust transfer of a satellite between two circular orbits, section 4.2.1 of the paper (orb_trans).
///
/// q = (r, φ), L = ½(ṙ² + r²φ̇²) + 1/r, f = (0, r u), C = u². Solved nondimensionally: length r⁰, time
/// sqrt(r⁰³/(γM)), mass of the satellite 1. The radii r⁰ and r^T are altitudes plus the Earth's radius (the paper
/// prints the altitudes 30 km and 330 km only). φ is unwrapped: φ(T) = 2πd after d revolutions, in the time T = d
/// sqrt(4π²/8 (1 + ρ)³) with ρ = r^T/r⁰.
class OrbitalTransfer final : public Problem {
 public:
  OrbitalTransfer()
      : Problem({
            {.name = "initial_altitude",
             .value = 30.0,
             .unit = "km",
             .meaning = "altitude of the first orbit",
             .lower = 0.0,
             .upper = 1e6},
            {.name = "target_altitude",
             .value = 330.0,
             .unit = "km",
             .meaning = "altitude of the last orbit",
             .lower = 0.0,
             .upper = 1e6},
            {.name = "revolutions",
             .value = 2.0,
             .unit = "",
             .meaning = "revolutions d during the transfer",
             .lower = 1.0,
             .upper = 1000.0,
             .whole = true},
            {.name = "earth_radius",
             .value = 6371.0,
             .unit = "km",
             .meaning = "radius of the Earth",
             .lower = 1.0,
             .upper = 1e6},
            {.name = "gravitational_parameter",
             .value = 398600.0,
             .unit = "km^3/s^2",
             .meaning = "gravitational constant times mass of the Earth",
             .lower = 1.0,
             .upper = 1e12},
        }) {}

  [[nodiscard]] std::string name() const override { return "orbital_transfer"; }
  [[nodiscard]] std::string description() const override {
    return "low thrust transfer of a satellite between two circular orbits, least control effort";
  }
  [[nodiscard]] std::string source() const override {
    return "Ober-Bloebaum, Junge, Marsden: Discrete Mechanics and Optimal Control: an Analysis, section 4.2.1";
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"r", "phi"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression& r = x.q[0];
    const Expression& r_dot = x.v[0];
    const Expression& phi_dot = x.v[1];
    return 0.5 * (r_dot * r_dot + r * r * phi_dot * phi_dot) + 1.0 / r;
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    ExpressionVector f(2);
    f << 0.0, x.q[0] * x.u[0];
    return f;
  }

  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }

  [[nodiscard]] BoundaryState initial_state() const override {
    return {.q = Eigen::Vector2d(1.0, 0.0), .v = Eigen::Vector2d(0.0, 1.0)};
  }

  [[nodiscard]] BoundaryState final_state() const override {
    const double rho = radius_ratio();
    return {.q = Eigen::Vector2d(rho, 2.0 * std::numbers::pi * parameter("revolutions")),
            .v = Eigen::Vector2d(0.0, std::pow(rho, -1.5))};
  }

  [[nodiscard]] double horizon() const override {
    using std::numbers::pi;
    return parameter("revolutions") * std::sqrt(4.0 * pi * pi / 8.0 * std::pow(1.0 + radius_ratio(), 3.0));
  }

  /// The optimum is about 4e-5.
  [[nodiscard]] double cost_scale() const override { return 1e4; }

  /// Rotations: ξ = (0, 1), the momentum is the angular momentum.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    ExpressionVector generator(2);
    generator << 0.0, 1.0;
    return generator;
  }

  [[nodiscard]] Unit time_unit() const override {
    constexpr double seconds_per_hour = 3600.0;
    return {.name = "h", .factor = time_scale() / seconds_per_hour};
  }

  [[nodiscard]] std::vector<PictureQuantity> picture(const ControlledState& x) const override {
    constexpr double metres_per_kilometre = 1e3;
    const double acceleration_scale = metres_per_kilometre * initial_radius() / (time_scale() * time_scale());  // m/s^2
    const Expression radius = initial_radius() * x.q[0];
    const Expression thrust = acceleration_scale * x.u[0];
    return {{"x", "km", radius * cos(x.q[1])},
            {"y", "km", radius * sin(x.q[1])},
            {"altitude", "km", radius - parameter("earth_radius")},
            {"thrust", "m/s^2", thrust},
            {"thrust_x", "m/s^2", -thrust * sin(x.q[1])},
            {"thrust_y", "m/s^2", thrust * cos(x.q[1])}};
  }

 private:
  /// r⁰ in km.
  [[nodiscard]] double initial_radius() const { return parameter("earth_radius") + parameter("initial_altitude"); }
  /// ρ = r^T / r⁰.
  [[nodiscard]] double radius_ratio() const {
    return (parameter("earth_radius") + parameter("target_altitude")) / initial_radius();
  }
  /// The unit of time in s.
  [[nodiscard]] double time_scale() const {
    return std::sqrt(std::pow(initial_radius(), 3.0) / parameter("gravitational_parameter"));
  }
};

}  // namespace dmocbench
