#pragma once

#include "problems/chaplygin_sleigh.hpp"

namespace dmocbench {

/// `chaplygin_sleigh` by the Lagrange-d'Alembert principle: q = (x, y, θ), the place of the contact and the attitude,
/// with the Lagrangian of the free body and the velocity constraint -ẋ sin θ + ẏ cos θ = 0;
///   L = ½m|ċ|² + ½J θ̇²,  c = (x + a cos θ, y + a sin θ),  f = (u₁ cos θ, u₁ sin θ, u₂).
class ChaplyginSleighCartesian : public ChaplyginSleigh {
 public:
  [[nodiscard]] std::string name() const override { return "chaplygin_sleigh_cartesian"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = ChaplyginSleigh::card();
    card.title = "Chaplygin sleigh (Cartesian)";
    card.source = "chaplygin_sleigh with a velocity constraint";
    card.guess = "x, y and theta on straight lines, u = 0";
    card.configuration_units = {"m", "m", "rad"};
    card.picture = {};
    return card;
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y", "theta"}; }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& /*x*/) const override { return {}; }

  [[nodiscard]] ExpressionVector velocity_constraints(const ExpressionVector& q,
                                                      const ExpressionVector& v) const override {
    return ExpressionVector{{cos(q[2]) * v[1] - sin(q[2]) * v[0]}};
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression ahead = varying("offset") * x.v[2];
    const Expression centre_x = x.v[0] - ahead * sin(x.q[2]);
    const Expression centre_y = x.v[1] + ahead * cos(x.q[2]);
    return 0.5 * varying("mass") * (centre_x * centre_x + centre_y * centre_y) +
           0.5 * varying("inertia") * x.v[2] * x.v[2];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0] * cos(x.q[2]), x.u[0] * sin(x.q[2]), x.u[1]}};
  }

  [[nodiscard]] BoundaryState initial_state() const override { return in_plane(ChaplyginSleigh::initial_state()); }
  [[nodiscard]] BoundaryState final_state() const override { return in_plane(ChaplyginSleigh::final_state()); }
  [[nodiscard]] ProblemBounds bounds() const override { return Problem::bounds(); }

  /// Rotations about the origin.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    return ExpressionVector{{-q[1], q[0], 1.0}};
  }

 private:
  static BoundaryState in_plane(const BoundaryState& end) {
    return BoundaryState::at_rest(Eigen::Vector3d(end.y[0], end.y[1], end.q[1]));
  }
};

}  // namespace dmocbench
