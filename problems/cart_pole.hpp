#pragma once

#include <cmath>
#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// Swing-up of a pendulum on a cart that is pushed, section 6 of Kelly's tutorial.
///
/// q = (x, θ), the cart's position and the pole's angle from hanging down, the bob at (x + l sin θ, -l cos θ);
///   L = ½(m₁ + m₂)ẋ² + m₂lẋθ̇ cos θ + ½m₂l²θ̇² + m₂gl cos θ,  f = (u, 0),  C = u²,
/// from hanging at x = 0 to upright at x = d, at rest, T = 2 s, |u| <= 20 N and |x| <= 2 m (neither is active along the
/// two minima that are known: θ swings back first, or forward first).
class CartPole : public Problem {
 public:
  CartPole()
      : Problem({
            {"cart_mass", 1.0, "kg", "mass m1 of the cart", 1e-3, 1e3},
            {"bob_mass", 0.3, "kg", "mass m2 of the bob", 1e-3, 1e3},
            {"length", 0.5, "m", "length l of the pole", 1e-3, 1e3},
            gravity_parameter(0.0),
            {"distance", 1.0, "m", "distance d that the cart travels", -2.0, 2.0},
            horizon_parameter(2.0, "swing-up"),
            switch_parameter("bounded", true, "1: bounds on force and position, 0: no bounds"),
        }) {}

  [[nodiscard]] std::string name() const override { return "cart_pole"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "swing-up of a pendulum on a cart in fixed time, with least control effort",
            .title = "Cart-pole swing-up",
            .axis_units = {.state = "m or rad", .control = "N", .momentum = "N s", .cost = "N² s", .energy = "N m"},
            .source = "Kelly: An Introduction to Trajectory Optimization, SIAM Review 59 (2017), section 6",
            .guess = "x = d t/T, theta = pi t/T - 2 sin(pi t/T), slopes v, u = 0",
            .configuration_units = {"m", "rad"},
            .control_units = {"N"},
            // The bounds need not hold: they are not active at the optimum.
            .reference = with_default_parameters(
                *this,
                {.objective = 57.9447803067,
                 .digits = 10,
                 .certificate = "Gauss and Lobatto with s = 4 on 192 intervals, a replay and the indirect method "
                                "without the bounds, which are not active, agree",
                 .published = {{58.8839489745, "Dymos, test_cartpole_opt.py, after the tutorial (tolerance 1e-3)"}},
                 .remark = "there are two minima: the pole swings back first (57.944780, near the guess) or forward "
                           "first (58.807667, near the straight line and the published value). Dymos adds u(T) = 0, so "
                           "its cost is 0.13 % above the second minimum"},
                {"bounded"}),
            .picture = [this](const ControlledState& x) -> Picture {
              const double l = parameter("length");
              return {{"cart_x", "m", x.q[0]},
                      {"bob_x", "m", x.q[0] + l * sin(x.q[1])},
                      {"bob_y", "m", -l * cos(x.q[1])},
                      {"force", "N", x.u[0]}};
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "theta"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression m1 = varying("cart_mass");
    const Expression m2 = varying("bob_mass");
    const Expression l = varying("length");
    const Expression& x_dot = x.v[0];
    const Expression& theta_dot = x.v[1];
    const Expression kinetic = 0.5 * (m1 + m2) * x_dot * x_dot + m2 * l * x_dot * theta_dot * cos(x.q[1]) +
                               0.5 * m2 * l * l * theta_dot * theta_dot;
    return kinetic + m2 * varying("gravity") * l * cos(x.q[1]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0], 0.0}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }

  [[nodiscard]] BoundaryState initial_state() const override { return BoundaryState::at_rest(Eigen::Vector2d::Zero()); }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::Vector2d(parameter("distance"), std::numbers::pi));
  }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }

  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    if (parameter("bounded") == 0.0) return bounds;
    constexpr double rail = 2.0;  // m to either side
    bounds.q = Bounds::none(2);
    bounds.q.lower[0] = -rail;
    bounds.q.upper[0] = rail;
    bounds.u = Bounds::all(1, -20.0, 20.0);  // N
    return bounds;
  }

  /// The optimum is about 58.
  [[nodiscard]] double cost_scale() const override { return 1e-2; }

  /// x on the straight line; θ swings back first, as in the cheaper of two minima.
  [[nodiscard]] MotionPoint guess(double t) const override {
    using std::numbers::pi;
    MotionPoint point = Problem::guess(t);
    const double phase = pi * t / horizon();
    point.q[1] -= swing_back * std::sin(phase);
    point.v[1] -= swing_back * pi / horizon() * std::cos(phase);
    return point;
  }

  /// Translations of the cart; the momentum of the whole changes by the work of the control alone.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{1.0, 0.0}};
  }

 private:
  static constexpr double swing_back = 2.0;  // rad
};

}  // namespace dmocbench
