#pragma once

#include <numbers>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The radius of an iron cannonball, and its launch, for the largest range: an example of Dymos, which has another
/// atmosphere.
///
/// q = (x, h), L = ½|q̇|² - g h per mass, f = -k |q̇| q̇ with k = ½ρ c_D πr²/m, ρ = 1.225 kg/m³ exp(-h/8440 m), c_D = ½,
/// m = 4/3 π r³ · 7870 kg/m³. The radius r is an unknown, the muzzle energy ½m|q̇(0)|² = 400 kJ a boundary condition,
/// the direction of the launch, T and x(T) are free, and h(T) = 0; Φ = -x(T). There are no controls: a solve chooses
/// numbers only. Solved in units of 1000 m and 10 s; the cost is in m.
class Cannonball final : public Problem {
 public:
  Cannonball() : Problem({{"radius", 0.05, "m", "radius of the ball", 0.01, 0.1, false, true}}) {}

  [[nodiscard]] std::string name() const override { return "cannonball"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "radius and launch of a cannonball of given muzzle energy for the largest range",
            .title = "Cannonball",
            .axis_units = {.state = "km", .cost = "m"},
            .source = "Falck, Gray, Ponnapalli, Wright: Dymos, example cannonball",
            .guess = "a parabola with a range of 3000 m and a duration of 25 s; radius 0.05 m",
            .time_unit = {.name = "s", .factor = 10.0},
            .reference = ReferenceOptimum{.objective = -3213.36476053,
                                          .digits = 12,
                                          .certificate =
                                              "Gauss with 3 stages on 512 intervals, with DMOC and both collocations"},
            .picture = [](const ControlledState& x) -> Picture {
              return {{"x", "m", length_unit * x.q[0]}, {"height", "m", length_unit * x.q[1]}};
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "height"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    constexpr double gravity = 9.80665 * time_unit * time_unit / length_unit;
    return 0.5 * x.v.dot(x.v) - gravity * x.q[1];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    constexpr double drag = 0.5;
    const Expression air_density = 1.225 * exp(-x.q[1] * (length_unit / 8440.0));
    const Expression radius = varying("radius");
    const Expression area = std::numbers::pi * radius * radius;
    const Expression factor = 0.5 * drag * length_unit * air_density * area / mass();
    const Expression speed = sqrt(x.v.dot(x.v));
    return ExpressionVector{{-factor * speed * x.v[0], -factor * speed * x.v[1]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& /*x*/) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override { return -length_unit * last.q[0]; }
  [[nodiscard]] ExpressionVector boundary_conditions(const State& first, const State& /*last*/) const override {
    constexpr double muzzle_energy = 4e5;  // J
    constexpr double velocity_unit = length_unit / time_unit;
    return ExpressionVector{
        {0.5 * velocity_unit * velocity_unit / muzzle_energy * mass() * first.v.dot(first.v) - 1.0}};
  }

  [[nodiscard]] BoundaryState initial_state() const override {
    return {.q = Eigen::Vector2d::Zero(), .v = Eigen::Vector2d(3.0, 3.0)};
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return {.q = Eigen::Vector2d(3.0, 0.0), .v = Eigen::Vector2d(1.0, -1.5)};
  }
  [[nodiscard]] double horizon() const override { return 2.5; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.first.free_velocity(0).free_velocity(1);
    bounds.last.free_velocity(0).free_velocity(1).free_configuration(0);
    bounds.horizon = {0.5, 10.0};
    return bounds;
  }
  /// The optimum is about -3200 m.
  [[nodiscard]] double cost_scale() const override { return 1e-3; }
  [[nodiscard]] MotionPoint guess(double t) const override {
    MotionPoint point = Problem::guess(t);
    point.q[1] = 3.0 * t - 1.2 * t * t;
    point.v[1] = 3.0 - 2.4 * t;
    return point;
  }

 private:
  static constexpr double length_unit = 1000.0;  // m
  static constexpr double time_unit = 10.0;      // s

  /// In kg.
  [[nodiscard]] Expression mass() const {
    constexpr double density = 7870.0;  // kg/m^3, of iron
    const Expression radius = varying("radius");
    return 4.0 / 3.0 * std::numbers::pi * density * radius * radius * radius;
  }
};

}  // namespace dmocbench
