#pragma once

#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// Two masses on springs that a harmonic force shakes; the control opens and closes a damper.
///
/// q = (x₁, x₂), L = ½m₁ẋ₁² + ½m₂ẋ₂² - ½k₁x₁² - ½k₂(x₂ - x₁)², f = (sin(2πt/T), -c(1 - u)ẋ₂): a force that depends on
/// time and one that is the product of control and velocity. C = ½(x₁² + x₂² + u²), |u| <= 1, T = 2π, q(0) = 0; the
/// initial velocity and the final state are free. Data: m = (100, 2) kg, k = (100, 3) N/m, c = 0.5 N s/m.
class DoubleOscillator : public Problem {
 public:
  DoubleOscillator()
      : Problem({
            {"mass_1", 100.0, "kg", "first mass", 1e-3, 1e6},
            {"mass_2", 2.0, "kg", "second mass", 1e-3, 1e6},
            {"stiffness_1", 100.0, "N/m", "spring between wall and first mass", 0.0, 1e6},
            {"stiffness_2", 3.0, "N/m", "spring between the masses", 0.0, 1e6},
            {"damping", 0.5, "N s/m", "damping of the second mass at u = 0", 0.0, 1e3},
        }) {}

  [[nodiscard]] std::string name() const override { return "double_oscillator"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {
        .description = "two shaken masses with a damper as the control; initial velocity and final state are free",
        .title = "Double oscillator",
        .axis_units = {.state = "m", .control = "dimensionless"},
        .source =
            "OptimalControlProblems.jl and CTBenchmarks.jl, problem double_oscillator, after Coudurier, Lepreux, "
            "Petit: Optimal bang-bang control of a mechanical double oscillator using averaging methods (2018)",
        .guess = "both masses at rest, u = 0",
        .reference = with_default_parameters(
            *this,
            {.objective = 9.11034863017e-4,
             .digits = 11,
             .certificate =
                 "Gauss with 3 stages and Lobatto with 4; the replays of both controls have the same cost to 12 digits",
             .published = {{0.000910190, "CTBenchmarks.jl, midpoint rule, N = 200"},
                           {0.000910336, "CTBenchmarks.jl, trapezoidal rule, N = 200"}},
             .remark = "the published values are specific to their grids: here the midpoint and the trapezoidal rule "
                       "on 200 intervals give 0.000910190 and 0.000910336, which converge to the reference as h^2"}),
        .picture = [this](const ControlledState& x) -> Picture {
          return {{"x_1", "m", x.q[0]},
                  {"x_2", "m", x.q[1]},
                  {"shaking_force", "N", sin(2.0 * std::numbers::pi / horizon() * x.t)},
                  {"u", "", x.u[0]}};
        }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x_1", "x_2"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression between = x.q[1] - x.q[0];
    return 0.5 * varying("mass_1") * x.v[0] * x.v[0] + 0.5 * varying("mass_2") * x.v[1] * x.v[1] -
           0.5 * varying("stiffness_1") * x.q[0] * x.q[0] - 0.5 * varying("stiffness_2") * between * between;
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{
        {sin(2.0 * std::numbers::pi / horizon() * x.t), -varying("damping") * (1.0 - x.u[0]) * x.v[1]}};
  }

  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * (x.q.dot(x.q) + x.u[0] * x.u[0]);
  }

  [[nodiscard]] BoundaryState initial_state() const override { return BoundaryState::at_rest(Eigen::Vector2d::Zero()); }
  [[nodiscard]] BoundaryState final_state() const override { return initial_state(); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.first.v = Bounds::none(2);
    bounds.last = {.q = Bounds::none(2), .v = Bounds::none(2)};
    bounds.u = Bounds::all(1, -1.0, 1.0);
    return bounds;
  }
  [[nodiscard]] double horizon() const override { return 2.0 * std::numbers::pi; }

  /// The optimum is about 1e-3.
  [[nodiscard]] double cost_scale() const override { return 1e3; }
};

}  // namespace dmocbench
