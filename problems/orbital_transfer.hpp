#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// The orbital transfer of the paper in any coordinates: data, units and duration.
///
/// Solved nondimensionally: length r⁰, time sqrt(r⁰³/(γM)), mass of the satellite 1. The radii r⁰ and r^T are altitudes
/// plus the Earth's radius (the paper prints the altitudes 30 km and 330 km only). After d revolutions the satellite is
/// on the target circle, in the time T = d sqrt(4π²/8 (1 + ρ)³) with ρ = r^T/r⁰.
class CircleToCircle : public Problem {
 public:
  [[nodiscard]] ProblemCard card() const override {
    constexpr double seconds_per_hour = 3600.0;
    ProblemCard card{
        .axis_units = AxisUnits::pure_numbers(),
        .source = "Ober-Bloebaum, Junge, Marsden: Discrete Mechanics and Optimal Control: an Analysis, section 4.2.1",
        .time_unit = {.name = "h", .factor = time_scale() / seconds_per_hour}};
    const double revolutions = parameter("revolutions");
    if (revolutions != 2.0 && revolutions != 10.0) return card;
    // The least cost does not depend on the coordinates.
    card.reference = with_default_parameters(
        *this,
        {.objective = revolutions == 2.0 ? 3.944909084747e-5 : 7.890332317683e-6,
         .digits = 13,
         .certificate = "the indirect method with Gauss schemes of orders 16 and 20, in polar and in Cartesian "
                        "coordinates; the replay of its control has the same cost to 13 digits",
         .remark = "the paper shows the cost only in a figure"},
        {"revolutions"});
    return card;
  }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }

  [[nodiscard]] double horizon() const override {
    using std::numbers::pi;
    return parameter("revolutions") * std::sqrt(4.0 * pi * pi / 8.0 * std::pow(1.0 + radius_ratio(), 3.0));
  }

  /// The optimum is about 4e-5.
  [[nodiscard]] double cost_scale() const override { return 1e4; }

 protected:
  /// With further parameters of a variant after the common ones.
  explicit CircleToCircle(const std::vector<Parameter>& more = {}) : Problem(with_own(more)) {}

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
  /// The unit of acceleration in m/s².
  [[nodiscard]] double acceleration_scale() const {
    constexpr double metres_per_kilometre = 1e3;
    return metres_per_kilometre * initial_radius() / (time_scale() * time_scale());
  }

 private:
  static std::vector<Parameter> with_own(const std::vector<Parameter>& more) {
    std::vector<Parameter> all{
        {"initial_altitude", 30.0, "km", "altitude of the first orbit", 0.0, 1e6},
        {"target_altitude", 330.0, "km", "altitude of the last orbit", 0.0, 1e6},
        {"revolutions", 2.0, "", "number d of revolutions", 1.0, 1000.0, true},
        {"earth_radius", 6371.0, "km", "radius of the Earth", 1.0, 1e6},
        {"gravitational_parameter", 398600.0, "km^3/s^2", "gravitational constant times mass of the Earth", 1.0, 1e12}};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

/// Low thrust transfer of a satellite between two circular orbits, section 4.2.1 of the paper (orb_trans).
///
/// q = (r, φ), L = ½(ṙ² + r²φ̇²) + 1/r, f = (0, r u), C = u², data and units of `CircleToCircle`. φ is unwrapped:
/// φ(T) = 2πd after d revolutions.
class OrbitalTransfer : public CircleToCircle {
 public:
  OrbitalTransfer() = default;

  [[nodiscard]] std::string name() const override { return "orbital_transfer"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = CircleToCircle::card();
    card.description = "low-thrust transfer of a satellite between two circular orbits, with least control effort";
    card.title = "Orbital transfer";
    card.picture = [this](const ControlledState& x) -> Picture {
      const Expression radius = initial_radius() * x.q[0];
      const Expression thrust = acceleration_scale() * x.u[0];
      return {{"x", "km", radius * cos(x.q[1])},
              {"y", "km", radius * sin(x.q[1])},
              {"altitude", "km", radius - parameter("earth_radius")},
              {"thrust", "m/s^2", thrust},
              {"thrust_x", "m/s^2", -thrust * sin(x.q[1])},
              {"thrust_y", "m/s^2", thrust * cos(x.q[1])}};
    };
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

 protected:
  using CircleToCircle::CircleToCircle;
};

}  // namespace dmocbench
