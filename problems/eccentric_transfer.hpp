#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// Low thrust transfer of a satellite between two ellipses: fast at the perigees, slow at the apogees.
///
/// q = (r, φ), L = ½(ṙ² + r²φ̇²) + 1/r, f = (0, r u), C = u² as in `OrbitalTransfer`. Nondimensional: length a⁰, the
/// first semi-major axis, time sqrt(a⁰³/(γM)), mass 1. Both ellipses have their apogee at φ = 0; from the apogee of the
/// first, after d revolutions, to the last one's, in the time T = 2πd ((a⁰ + a^T)/2)^(3/2). At an apogee r = a(1 +
/// e), ṙ = 0, φ̇ = sqrt(a(1 - e²))/r².
class EccentricTransfer : public Problem {
 public:
  EccentricTransfer()
      : Problem({
            {"initial_eccentricity", 0.8, "", "eccentricity of the first ellipse", 0.0, 0.8},
            {"target_eccentricity", 0.6, "", "eccentricity of the last ellipse", 0.0, 0.8},
            {"axis_ratio", 1.2, "", "semi-major axis of the last ellipse divided by the axis of the first", 0.1, 10.0},
            {"revolutions", 2.0, "", "number d of revolutions", 1.0, 100.0, true},
        }) {}

  [[nodiscard]] std::string name() const override { return "eccentric_transfer"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {
        .description = "low-thrust transfer of a satellite between two ellipses, with least control effort",
        .title = "Transfer between ellipses",
        .axis_units = AxisUnits::pure_numbers(),
        .source =
            "stated for this library, after the transfer between circles of Ober-Bloebaum, Junge, Marsden: Discrete "
            "Mechanics and Optimal Control: an Analysis, section 4.2.1",
        .guess = "trajectory on an ellipse whose axis and eccentricity change linearly with time, u = 0",
        .time_unit = {.name = "", .factor = 1.0},
        .reference = with_default_parameters(
            *this, {.objective = 2.5954854061e-3,
                    .digits = 11,
                    .certificate = "the indirect method with Gauss schemes of orders 16 and 20; DMOC with three "
                                   "stages on an adapted grid has the same cost to 12 digits"}),
        .picture = [](const ControlledState& x) -> Picture {
          return {{"x", "", x.q[0] * cos(x.q[1])},
                  {"y", "", x.q[0] * sin(x.q[1])},
                  {"r", "", x.q[0]},
                  {"thrust", "", x.u[0]}};
        }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"r", "phi"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression& r = x.q[0];
    return 0.5 * (x.v[0] * x.v[0] + r * r * x.v[1] * x.v[1]) + 1.0 / r;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{0.0, x.q[0] * x.u[0]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }

  [[nodiscard]] BoundaryState initial_state() const override {
    return at_apogee({1.0, parameter("initial_eccentricity")}, 0.0);
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return at_apogee({parameter("axis_ratio"), parameter("target_eccentricity")}, angle());
  }
  [[nodiscard]] double horizon() const override { return angle() * std::pow(0.5 + 0.5 * parameter("axis_ratio"), 1.5); }

  /// The optimum is about 3e-3.
  [[nodiscard]] double cost_scale() const override { return 1e2; }

  [[nodiscard]] MotionPoint guess(double t) const override {
    const double axis_rate = (parameter("axis_ratio") - 1.0) / horizon();
    const double e_rate = (parameter("target_eccentricity") - parameter("initial_eccentricity")) / horizon();
    const double axis = 1.0 + t * axis_rate;
    const double e = parameter("initial_eccentricity") + t * e_rate;
    const double angle_rate = angle() / horizon();
    const double whole = 2.0 * std::numbers::pi * std::round(angle_rate * t / (2.0 * std::numbers::pi));
    const double anomaly = eccentric_anomaly(angle_rate * t - whole, e);
    const double sine = std::sin(anomaly);
    const double cosine = std::cos(anomaly);
    const double radius = 1.0 + e * cosine;  // over the axis
    const double root = std::sqrt(1.0 - e * e);
    const double anomaly_rate = (angle_rate - e_rate * sine) / radius;
    return {.q = Eigen::Vector2d(axis * radius, whole + anomaly - 2.0 * std::atan2(e * sine, 1.0 + root + e * cosine)),
            .v = Eigen::Vector2d(axis_rate * radius + axis * (e_rate * cosine - e * sine * anomaly_rate),
                                 (root * anomaly_rate - sine / root * e_rate) / radius),
            .u = Eigen::VectorXd::Zero(1)};
  }

  /// Rotations: ξ = (0, 1), the momentum is the angular momentum.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{0.0, 1.0}};
  }

 private:
  struct Ellipse {
    double axis;
    double eccentricity;
  };
  /// φ(T).
  [[nodiscard]] double angle() const { return 2.0 * std::numbers::pi * parameter("revolutions"); }
  [[nodiscard]] static BoundaryState at_apogee(const Ellipse& ellipse, double angle) {
    const double e = ellipse.eccentricity;
    const double radius = ellipse.axis * (1.0 + e);
    return {.q = Eigen::Vector2d(radius, angle),
            .v = Eigen::Vector2d(0.0, std::sqrt(ellipse.axis * (1.0 - e * e)) / (radius * radius))};
  }
  /// The E with E + e sin E = `mean` in [-π, π]: Kepler's equation from the apogee, by Newton's method from there,
  /// whence it converges monotonically.
  [[nodiscard]] static double eccentric_anomaly(double mean, double e) {
    constexpr int steps = 16;  // rounding is all that is left for e <= 0.8
    double anomaly = 0.0;
    for (int i = 0; i < steps; ++i) anomaly -= (anomaly + e * std::sin(anomaly) - mean) / (1.0 + e * std::cos(anomaly));
    return anomaly;
  }
};

}  // namespace dmocbench
