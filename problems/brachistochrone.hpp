#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// The fastest descent, as an optimal control problem with free horizon: the reaction of the wire is the control.
///
/// q = (x, y), L = ½|q̇|² - gy, f = u(-ẏ, ẋ) (it does no work), minimise T from (0, 10) at rest to (10, 5), final
/// velocity free. The cycloid x = R(φ - sin φ), y = y⁰ - R(1 - cos φ), φ = ωt, ω = sqrt(g/R), needs the constant
/// control u = ω, so that T = φ₁ sqrt(R/g) with φ₁ and R such that it meets the end. The Hamiltonian is linear in u:
/// the whole optimum is a singular arc. At t = 0, where the velocity is zero, the control has no effect: Gauss has no
/// stage there, but Lobatto has one and leaves its control undetermined. Data of the Dymos example (metres, seconds).
class Brachistochrone : public Problem {
 public:
  Brachistochrone()
      : Problem({
            {"width", 10.0, "m", "x of the end point", 1e-3, 1e3},
            {"drop", 5.0, "m", "height y of the descent", 1e-3, 1e3},
            gravity_parameter(1e-3, 9.80665),
        }) {}

  [[nodiscard]] std::string name() const override { return "brachistochrone"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {
        .description = "the fastest descent between two points, controlled by the wire's reaction; free horizon",
        .title = "Brachistochrone",
        .axis_units = {.state = "m", .control = "1/s", .momentum = "m/s", .cost = "s"},
        .source = "Johann Bernoulli 1696; data of the Dymos example",
        .guess = "the slide down a straight wire; u is its reaction divided by the speed at half the time",
        .reference = reference_optimum(),
        .picture = [](const ControlledState& x) -> Picture {
          const Expression speed = sqrt(x.v[0] * x.v[0] + x.v[1] * x.v[1]);
          return {
              {"x", "m", x.q[0]}, {"y", "m", x.q[1]}, {"speed", "m/s", speed}, {"reaction", "m/s^2", x.u[0] * speed}};
        }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * (x.v[0] * x.v[0] + x.v[1] * x.v[1]) - varying("gravity") * x.q[1];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{-x.u[0] * x.v[1], x.u[0] * x.v[0]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& /*x*/) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override { return last.t; }

  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::Vector2d(0.0, start_height));
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::Vector2d(parameter("width"), start_height - parameter("drop")));
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    constexpr double factor = 10.0;
    bounds.last.free_velocity(0).free_velocity(1);
    bounds.horizon = {horizon() / factor, horizon() * factor};
    return bounds;
  }
  /// The time of the guess, a slide down a straight wire.
  [[nodiscard]] double horizon() const override {
    const double w = parameter("width");
    const double d = parameter("drop");
    return std::sqrt(2.0 * (w * w + d * d) / (parameter("gravity") * d));
  }

  /// The slide down a straight wire, with the u of its reaction at half the horizon.
  [[nodiscard]] MotionPoint guess(double t) const override {
    const Eigen::Vector2d way(parameter("width"), -parameter("drop"));
    const double tau = t / horizon();
    const double speed_at_half = way.norm() / horizon();
    const double normal_gravity = parameter("gravity") * parameter("width") / way.norm();
    return {.q = initial_state().q + tau * tau * way,
            .v = 2.0 * tau / horizon() * way,
            .u = Eigen::VectorXd::Constant(1, normal_gravity / speed_at_half)};
  }

  /// Horizontal translations; gravity does not act on this momentum.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{1.0, 0.0}};
  }

  /// (R, φ₁) of the cycloid through both points: (φ - sin φ)/(1 - cos φ) = width/drop has one solution in (0, 2π).
  [[nodiscard]] std::pair<double, double> cycloid() const {
    const double w = parameter("width");
    const double d = parameter("drop");
    double low = 0.0;
    double high = 2.0 * std::numbers::pi;
    for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high)) {
      const double excess = d * (middle - std::sin(middle)) - w * (1.0 - std::cos(middle));  // rises through 0
      (excess < 0.0 ? low : high) = middle;
    }
    return {d / (1.0 - std::cos(low)), low};
  }

 private:
  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const {
    const auto [radius, angle] = cycloid();
    ReferenceOptimum optimum{.objective = angle * std::sqrt(radius / parameter("gravity")),
                             .digits = 15,
                             .certificate = "closed form, the cycloid through both points",
                             .remark =
                                 "Lobatto tableaus leave the control at t = 0 undetermined and converge slowly or not "
                                 "at all; use Gauss tableaus to certify"};
    if (has_default_parameters()) optimum.published.push_back({1.8016, "Dymos, example brachistochrone"});
    const bool is_psopt = parameter("width") == 2.0 && parameter("drop") == 2.0 && parameter("gravity") == 9.8;
    if (is_psopt) optimum.published.push_back({0.8247591, "PSOPT, example brac1"});
    return optimum;
  }

  static constexpr double start_height = 10.0;
};

}  // namespace dmocbench
