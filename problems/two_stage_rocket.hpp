#pragma once

#include <memory>

#include "methods/mechanics/phased_problem.hpp"
#include "problems/phase_between.hpp"

namespace dmocbench {

/// The ascent of a rocket of two stages with the least effort of its engines.
///
/// q is the distance r from the centre of the planet, the mass m a first-order state, L = m (½ṙ² + 1/r). The thrust u
/// uses ṁ = -u/c, c = 1.5 of the first and 2 of the second stage; f = u + ṁ ṙ - ½ṙ² exp(-5 (r - 1)), C = ½u². From rest
/// at r = 1 with m = 1 to r = 1.1 with 0.2 after T = 0.6. When m = 0.75, the first stage is empty and its structure of
/// 0.1 is dropped: r and ṙ are continuous, the momentum is not. (Were it, J would be 0.331753.)
class TwoStageRocket final : public PhasedProblem {
 public:
  TwoStageRocket()
      : PhasedProblem(
            {{"first", std::make_shared<Stage>(1.5, at(1.0, 0.0, 1.0), open(1.04, 0.3, empty), true)},
             {"second", std::make_shared<Stage>(2.0, open(1.04, 0.3, empty - structure), at(1.1, 0.2, 0.5), false)}}) {}

  [[nodiscard]] std::string name() const override { return "two_stage_rocket"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = PhasedProblem::card();
    card.description = "ascent of a rocket that drops its first stage, with least control effort";
    card.title = "Two-stage rocket";
    card.axis_units = AxisUnits::pure_numbers();
    card.source = "a drop of mass in its simplest form, stated for this library";
    card.reference = ReferenceOptimum{
        .objective = 0.347715230972414,
        .digits = 14,
        .certificate = "indirect shooting over both phases to 12 digits; the Gauss and Lobatto schemes of order 6"};
    return card;
  }

  [[nodiscard]] ExpressionVector link(std::size_t /*i*/, const PhaseEnd& before, const PhaseEnd& after) const override {
    return dropped(before, after, ExpressionVector{{structure}});
  }
  [[nodiscard]] ExpressionVector conditions(const std::vector<PhaseEnd>& /*first*/,
                                            const std::vector<PhaseEnd>& last) const override {
    return ExpressionVector{{last.back().t - 0.6}};
  }

 private:
  static constexpr double empty = 0.75;     // mass of the rocket when its first stage is
  static constexpr double structure = 0.1;  // mass of that stage then

  class Stage final : public PhaseBetween {
   public:
    Stage(double exhaust_speed, End first, End last, bool has_given_mass)
        : PhaseBetween(std::move(first), std::move(last), {0.01, 1.0}, 0.3),
          exhaust_speed_(exhaust_speed),
          has_given_mass_(has_given_mass) {}
    [[nodiscard]] std::string name() const override { return "stage"; }
    [[nodiscard]] ProblemCard card() const override { return {.time_unit = {.name = "", .factor = 1.0}}; }
    [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"r"}; }
    [[nodiscard]] std::vector<std::string> control_names() const override { return {"thrust"}; }
    [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"mass"}; }
    [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
      return ExpressionVector{{-x.u[0] / exhaust_speed_}};
    }
    [[nodiscard]] Expression lagrangian(const State& x) const override {
      return x.y[0] * (0.5 * x.v[0] * x.v[0] + 1.0 / x.q[0]);
    }
    [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
      const Expression drag = 0.5 * x.v[0] * x.v[0] * exp(-5.0 * (x.q[0] - 1.0));
      return ExpressionVector{{x.u[0] + first_order_rates(x)[0] * x.v[0] - drag}};
    }
    [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }
    [[nodiscard]] ProblemBounds bounds() const override {
      ProblemBounds bounds = PhaseBetween::bounds();
      bounds.last.y = has_given_mass_ ? Bounds::fixed(final_state().y) : Bounds::none(1);
      return bounds;
    }

   private:
    double exhaust_speed_;
    bool has_given_mass_;  // at its end
  };

  static PhaseBetween::End at(double r, double v, double mass) {
    return {{.q = Eigen::VectorXd::Constant(1, r),
             .v = Eigen::VectorXd::Constant(1, v),
             .y = Eigen::VectorXd::Constant(1, mass)}};
  }
  static PhaseBetween::End open(double r, double v, double mass) { return {at(r, v, mass).state, true}; }
};

}  // namespace dmocbench
