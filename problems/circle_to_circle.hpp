#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "methods/mechanics/problem.hpp"

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
    return {
        .source = "Ober-Bloebaum, Junge, Marsden: Discrete Mechanics and Optimal Control: an Analysis, section 4.2.1",
        .time_unit = {.name = "h", .factor = time_scale() / seconds_per_hour},
        .reference = reference_optimum()};
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
  CircleToCircle()
      : Problem({
            {"initial_altitude", 30.0, "km", "altitude of the first orbit", 0.0, 1e6},
            {"target_altitude", 330.0, "km", "altitude of the last orbit", 0.0, 1e6},
            {"revolutions", 2.0, "", "revolutions d during the transfer", 1.0, 1000.0, true},
            {"earth_radius", 6371.0, "km", "radius of the Earth", 1.0, 1e6},
            {"gravitational_parameter", 398600.0, "km^3/s^2", "gravitational constant times mass of the Earth", 1.0,
             1e12},
        }) {}

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
  /// The least cost does not depend on the coordinates.
  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const {
    constexpr double after_two = 3.944909084747e-5;
    constexpr double after_ten = 7.890332317683e-6;
    const double revolutions = parameter("revolutions");
    const bool is_known = revolutions == 2.0 || revolutions == 10.0;
    if (!is_known || !has_default_parameters({"revolutions"})) return std::nullopt;
    return ReferenceOptimum{
        .objective = revolutions == 2.0 ? after_two : after_ten,
        .digits = 13,
        .certificate =
            "the indirect method with Gauss of orders 16 and 20, in polar and in Cartesian coordinates; the "
            "replay of its control has the same cost to 13 digits",
        .remark = "the paper shows the cost in a figure only"};
  }
};

}  // namespace dmocbench
