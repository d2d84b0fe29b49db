#pragma once

#include "problems/two_link_manipulator.hpp"

namespace dmocbench {

/// Swing-up of the paper's two-link arm by direct-current motors in its joints.
///
/// y = (i₁, i₂), the currents, with L di/dt = U - R i - k ω; the torques are τ = k i, the controls the voltages u = U,
/// ω = (θ̇₁, θ̇₂ - θ̇₁) the rates of the joints. C = ½|i|² + ½ρ|U|²: the heat, and a little for the voltage, without which
/// it would have no bound. Without currents at the start; those at the end are free. R = 1 Ω, L = 0.1 H, k = 1 N m/A,
/// ρ = 0.01 A²/V².
class TwoLinkWithMotors final : public TwoLinkManipulator {
 public:
  [[nodiscard]] std::string name() const override { return "two_link_with_motors"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = TwoLinkManipulator::card();
    card.description = "swing-up of a planar two-link arm driven by motors with inductance, with least heat";
    card.title = "Two-link manipulator with motors";
    card.axis_units = {.state = "rad"};
    card.source = "two_link_manipulator with motors in its joints";
    card.reference = with_default_parameters(
        *this, {.objective = 83.8281466682,
                .digits = 12,
                .certificate = "Gauss with 3 stages on 256 and 512 intervals, with DMOC and tangent-space collocation",
                .remark = "another minimum at 93.27"});
    card.picture = [base = card.picture](const ControlledState& x) -> Picture {
      Picture picture = base(x);
      picture.resize(4);
      picture.push_back({"torque_1", "N m", x.y[0]});
      picture.push_back({"torque_2", "N m", x.y[1]});
      return picture;
    };
    return card;
  }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"voltage_1", "voltage_2"}; }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"current_1", "current_2"}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return ExpressionVector{
        {(x.u[0] - x.y[0] - x.v[0]) / inductance, (x.u[1] - x.y[1] - (x.v[1] - x.v[0])) / inductance}};
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.y[0] - x.y[1], x.y[1]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * x.y.dot(x.y) + 0.5 * 0.01 * x.u.dot(x.u);
  }

  [[nodiscard]] BoundaryState initial_state() const override {
    return without_current(TwoLinkManipulator::initial_state());
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return without_current(TwoLinkManipulator::final_state());
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_first_order(0).free_first_order(1);
    return bounds;
  }

 private:
  static constexpr double inductance = 0.1;  // H

  static BoundaryState without_current(BoundaryState state) {
    state.y = Eigen::VectorXd::Zero(2);
    return state;
  }
};

}  // namespace dmocbench
