#pragma once

#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "problems/default_parameters.hpp"

namespace dmocbench {

/// Two masses on springs that a harmonic force shakes; the control opens and closes a damper.
///
/// q = (x₁, x₂), L = ½m₁ẋ₁² + ½m₂ẋ₂² - ½k₁x₁² - ½k₂(x₂ - x₁)², f = (sin(2πt/T), -c(1 - u)ẋ₂): a force that depends on
/// time and one that is the product of control and velocity. C = ½(x₁² + x₂² + u²), |u| <= 1, T = 2π, q(0) = 0; the
/// initial velocity and the final state are free. Data: m = (100, 2) kg, k = (100, 3) N/m, c = 0.5 N s/m.
class DoubleOscillator final : public Problem {
 public:
  DoubleOscillator()
      : Problem({
            {.name = "mass_1", .value = 100.0, .unit = "kg", .meaning = "first mass", .lower = 1e-3, .upper = 1e6},
            {.name = "mass_2", .value = 2.0, .unit = "kg", .meaning = "second mass", .lower = 1e-3, .upper = 1e6},
            {.name = "stiffness_1",
             .value = 100.0,
             .unit = "N/m",
             .meaning = "spring between wall and first mass",
             .lower = 0.0,
             .upper = 1e6},
            {.name = "stiffness_2",
             .value = 3.0,
             .unit = "N/m",
             .meaning = "spring between the masses",
             .lower = 0.0,
             .upper = 1e6},
            {.name = "damping",
             .value = 0.5,
             .unit = "N s/m",
             .meaning = "damping of the second mass at u = 0",
             .lower = 0.0,
             .upper = 1e3},
        }) {}

  [[nodiscard]] std::string name() const override { return "double_oscillator"; }
  [[nodiscard]] std::string description() const override {
    return "two shaken masses whose damper is the control, initial velocity and final state free";
  }
  [[nodiscard]] std::string source() const override {
    return "OptimalControlProblems.jl and CTBenchmarks.jl, problem double_oscillator, after Coudurier, Lepreux, Petit: "
           "Optimal bang-bang control of a mechanical double oscillator using averaging methods (2018)";
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x_1", "x_2"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression between = x.q[1] - x.q[0];
    return 0.5 * parameter("mass_1") * x.v[0] * x.v[0] + 0.5 * parameter("mass_2") * x.v[1] * x.v[1] -
           0.5 * parameter("stiffness_1") * x.q[0] * x.q[0] - 0.5 * parameter("stiffness_2") * between * between;
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    ExpressionVector f(2);
    f << sin(2.0 * std::numbers::pi / horizon() * x.t), -parameter("damping") * (1.0 - x.u[0]) * x.v[1];
    return f;
  }

  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * (x.q.dot(x.q) + x.u[0] * x.u[0]);
  }

  [[nodiscard]] BoundaryState initial_state() const override {
    return {.q = Eigen::Vector2d::Zero(), .v = Eigen::Vector2d::Zero()};
  }
  [[nodiscard]] BoundaryState final_state() const override { return initial_state(); }
  [[nodiscard]] EndBounds initial_bounds() const override {
    return {.q = Bounds::fixed(Eigen::Vector2d::Zero()), .v = Bounds::none(2)};
  }
  [[nodiscard]] EndBounds final_bounds() const override { return {.q = Bounds::none(2), .v = Bounds::none(2)}; }
  [[nodiscard]] double horizon() const override { return 2.0 * std::numbers::pi; }

  [[nodiscard]] Bounds control_bounds() const override {
    return {Eigen::VectorXd::Constant(1, -1.0), Eigen::VectorXd::Constant(1, 1.0)};
  }

  /// The optimum is about 1e-3.
  [[nodiscard]] double cost_scale() const override { return 1e3; }

  [[nodiscard]] std::string guess_description() const override { return "everything at rest, u = 0"; }

  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const override {
    if (!has_default_parameters(*this)) return std::nullopt;
    return ReferenceOptimum{
        .objective = 9.11034863017e-4,
        .digits = 11,
        .certificate =
            "Gauss with 3 stages and Lobatto with 4; the replays of both controls have the same cost to 12 "
            "digits",
        .published = {{0.000910190, "CTBenchmarks.jl, midpoint rule, N = 200"},
                      {0.000910336, "CTBenchmarks.jl, trapezoidal rule, N = 200"}},
        .remark =
            "the published values are those of their grids: ours of the midpoint and the trapezoidal rule on 200 "
            "intervals are 0.000910190 and 0.000910336, and converge to the reference as h^2"};
  }

  [[nodiscard]] std::vector<PictureQuantity> picture(const ControlledState& x) const override {
    return {{"x_1", "m", x.q[0]},
            {"x_2", "m", x.q[1]},
            {"shaking_force", "N", sin(2.0 * std::numbers::pi / horizon() * x.t)},
            {"u", "", x.u[0]}};
  }
};

}  // namespace dmocbench
