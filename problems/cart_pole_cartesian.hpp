#pragma once

#include "problems/cart_pole.hpp"
#include "problems/redundant_statement.hpp"

namespace dmocbench {

/// `cart_pole` as two points that a rod joins: q = (s, x, y), the cart's position and the place of the bob, with the
/// constraint (x - s)² + y² - l² = 0;
///   L = ½m₁ṡ² + ½m₂(ẋ² + ẏ²) - m₂gy,  f = (u, 0, 0),  C = u².
class CartPoleCartesian final : public RedundantStatement<CartPole> {
 public:
  [[nodiscard]] std::string name() const override { return "cart_pole_cartesian"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    const ProblemCard of_angles = minimal().card();
    return {.description = "swing-up of a pendulum on a cart in fixed time, as two points joined by a rod",
            .title = "Cart-pole swing-up (Cartesian)",
            .axis_units = {.state = "m", .control = "N", .momentum = "N s", .cost = "N² s", .energy = "N m"},
            .source = "cart_pole in Cartesian coordinates with one constraint",
            .guess = "as in cart_pole",
            .reference = of_angles.reference,
            .picture = [](const ControlledState& x) -> Picture {
              return {{"cart_x", "m", x.q[0]}, {"bob_x", "m", x.q[1]}, {"bob_y", "m", x.q[2]}, {"force", "N", x.u[0]}};
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"cart_x", "bob_x", "bob_y"}; }

  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    const Expression l = varying("length");
    const Expression across = q[1] - q[0];
    return ExpressionVector{{across * across + q[2] * q[2] - l * l}};
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression m2 = varying("bob_mass");
    return 0.5 * varying("cart_mass") * x.v[0] * x.v[0] + 0.5 * m2 * (x.v[1] * x.v[1] + x.v[2] * x.v[2]) -
           m2 * varying("gravity") * x.q[2];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0], 0.0, 0.0}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }

  /// `cart_pole`'s bounds on the force and on the cart.
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    const ProblemBounds minimal_bounds = minimal().bounds();
    bounds.u = minimal_bounds.u;
    if (minimal_bounds.q.empty()) return bounds;
    bounds.q = Bounds::none(3);
    bounds.q.lower[0] = minimal_bounds.q.lower[0];
    bounds.q.upper[0] = minimal_bounds.q.upper[0];
    return bounds;
  }

  /// Translations of the cart with the pole.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{1.0, 1.0, 0.0}};
  }

  [[nodiscard]] ExpressionVector embedding(const ExpressionVector& theta) const override {
    const Expression l = parameter("length");
    return ExpressionVector{{theta[0], theta[0] + l * sin(theta[1]), -l * cos(theta[1])}};
  }
};

}  // namespace dmocbench
