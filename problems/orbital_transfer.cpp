#include "problems/orbital_transfer.hpp"

#include <cmath>
#include <numbers>

namespace dmocbench {

using std::numbers::pi;

OrbitalTransfer::OrbitalTransfer()
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

std::string OrbitalTransfer::description() const {
  return "low thrust transfer of a satellite between two circular orbits, least control effort";
}

std::string OrbitalTransfer::source() const {
  return "Ober-Bloebaum, Junge, Marsden: Discrete Mechanics and Optimal Control: an Analysis, section 4.2.1";
}

Expression OrbitalTransfer::lagrangian(const State& x) const {
  const Expression& r = x.q[0];
  const Expression& r_dot = x.v[0];
  const Expression& phi_dot = x.v[1];
  return 0.5 * (r_dot * r_dot + r * r * phi_dot * phi_dot) + 1.0 / r;
}

ExpressionVector OrbitalTransfer::force(const ControlledState& x) const {
  ExpressionVector f(2);
  f << 0.0, x.q[0] * x.u[0];
  return f;
}

Expression OrbitalTransfer::running_cost(const ControlledState& x) const { return x.u[0] * x.u[0]; }

BoundaryState OrbitalTransfer::initial_state() const {
  return {.q = Eigen::Vector2d(1.0, 0.0), .v = Eigen::Vector2d(0.0, 1.0)};
}

BoundaryState OrbitalTransfer::final_state() const {
  const double rho = radius_ratio();
  return {.q = Eigen::Vector2d(rho, 2.0 * pi * parameter("revolutions")),
          .v = Eigen::Vector2d(0.0, std::pow(rho, -1.5))};
}

double OrbitalTransfer::horizon() const {
  return parameter("revolutions") * std::sqrt(4.0 * pi * pi / 8.0 * std::pow(1.0 + radius_ratio(), 3.0));
}

std::optional<ExpressionVector> OrbitalTransfer::symmetry(const ExpressionVector& /*q*/) const {
  ExpressionVector generator(2);
  generator << 0.0, 1.0;
  return generator;
}

Unit OrbitalTransfer::time_unit() const {
  constexpr double seconds_per_hour = 3600.0;
  return {"h", time_scale() / seconds_per_hour};
}

std::vector<PictureQuantity> OrbitalTransfer::picture(const ControlledState& x) const {
  constexpr double metres_per_kilometre = 1e3;
  const double acceleration_scale =
      metres_per_kilometre * initial_radius() / (time_scale() * time_scale());  // m/s^2
  const Expression radius = initial_radius() * x.q[0];
  const Expression thrust = acceleration_scale * x.u[0];
  return {{"x", "km", radius * cos(x.q[1])},
          {"y", "km", radius * sin(x.q[1])},
          {"thrust", "m/s^2", thrust},
          {"thrust_x", "m/s^2", -thrust * sin(x.q[1])},
          {"thrust_y", "m/s^2", thrust * cos(x.q[1])}};
}

double OrbitalTransfer::initial_radius() const { return parameter("earth_radius") + parameter("initial_altitude"); }

double OrbitalTransfer::radius_ratio() const {
  return (parameter("earth_radius") + parameter("target_altitude")) / initial_radius();
}

double OrbitalTransfer::time_scale() const {
  return std::sqrt(std::pow(initial_radius(), 3.0) / parameter("gravitational_parameter"));
}

}  // namespace dmocbench
