#pragma once

#include <cmath>
#include <numbers>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Steering a particle by the direction of a constant thrust, problem 10 of COPS: the bilinear tangent law.
///
/// q = (x, y), L = ½|q̇|², f = a(cos u, sin u), |u| <= π/2; minimise T from (0, 0) at rest to y = 5 with the velocity
/// (45, 0), x(T) free; a = 100. COPS gives no units; metres and seconds fit.
///
/// Closed form: tan u = c(1 - 2τ) with τ = t/T, and with I = arcsinh(c)/c, ẋ(T) = aTI and
/// y(T) = aT²(sqrt(1 + c²) - I)/(4c); eliminating T leaves one equation for c.
class ParticleSteering : public Problem {
 public:
  ParticleSteering()
      : Problem({
            {"thrust", 100.0, "m/s^2", "acceleration a of the thrust", 1.0, 1e4},
            {"height", 5.0, "m", "height y to reach", 1e-2, 1e2},
            {"speed", 45.0, "m/s", "speed to reach", 1.0, 1e3},
        }) {}

  [[nodiscard]] std::string name() const override { return "particle_steering"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "particle steered by the direction of its thrust to a height and speed in the shortest time",
            .title = "Particle steering",
            .axis_units = {.state = "m", .control = "rad", .momentum = "m/s", .cost = "s"},
            .source = "Dolan, More, Munson: Benchmarking Optimization Software with COPS 3.0, problem 10",
            .reference = reference_optimum(),
            .picture = [](const ControlledState& x) -> Picture {
              constexpr double degrees = 180.0 / std::numbers::pi;
              return {{"x", "m", x.q[0]}, {"y", "m", x.q[1]}, {"direction", "degree", degrees * x.u[0]}};
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * (x.v[0] * x.v[0] + x.v[1] * x.v[1]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression a = varying("thrust");
    return ExpressionVector{{a * cos(x.u[0]), a * sin(x.u[0])}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& /*x*/) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override { return last.t; }

  [[nodiscard]] BoundaryState initial_state() const override { return BoundaryState::at_rest(Eigen::Vector2d::Zero()); }
  /// The guess of the free x(T) comes from constant acceleration.
  [[nodiscard]] BoundaryState final_state() const override {
    const double v = parameter("speed");
    return {.q = Eigen::Vector2d(0.5 * v * horizon(), parameter("height")), .v = Eigen::Vector2d(v, 0.0)};
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_configuration(0);
    bounds.horizon = {1e-2, 1e2};
    bounds.u = Bounds::all(1, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
    return bounds;
  }
  /// COPS guesses T = 1.
  [[nodiscard]] double horizon() const override { return 1.0; }

  /// tan u at t = 0.
  [[nodiscard]] double initial_tangent() const {
    // y(T) a / ẋ(T)² = (sqrt(1 + c²) - I)/(4 c I²), which rises from 0 (like c/6) to infinity.
    const double wanted = parameter("height") * parameter("thrust") / (parameter("speed") * parameter("speed"));
    const auto ratio = [](double c) {
      const double i = std::asinh(c) / c;
      return (std::sqrt(1.0 + c * c) - i) / (4.0 * c * i * i);
    };
    double low = 0.0;
    double high = 1.0;
    while (ratio(high) < wanted) high *= 2.0;
    for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high)) {
      (ratio(middle) < wanted ? low : high) = middle;
    }
    return low;
  }

  /// Translations along x; only the thrust changes their momentum.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{1.0, 0.0}};
  }

 private:
  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const {
    const double c = initial_tangent();
    ReferenceOptimum optimum{.objective = parameter("speed") * c / (parameter("thrust") * std::asinh(c)),
                             .digits = 15,
                             .certificate = "closed form, the bilinear tangent law"};
    if (has_default_parameters()) {
      optimum.published = {{0.554577, "COPS 3.0 and the tests of COPSBenchmark.jl"}, {0.5545709, "PSOPT, example lts"}};
      optimum.remark =
          "the value of COPS is specific to a coarse grid: the trapezoidal rule gives 0.5545770 on 100 intervals here "
          "and 0.5545724 on 200";
    }
    return optimum;
  }
};

}  // namespace dmocbench
