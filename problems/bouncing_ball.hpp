#pragma once

#include <memory>

#include "methods/mechanics/phased_problem.hpp"
#include "problems/common_parameters.hpp"
#include "problems/phase_between.hpp"

namespace dmocbench {

/// A ball that falls, bounces once and rises, with the least effort.
///
/// In both phases L = ½ż² - gz, f = u, C = ½u², mass 1 kg. From rest at 1 m to 1.1 m with 0.5 m/s after 1.2 s; the time
/// of the impact is free. There z = 0 and v⁺ = -e v⁻, the impulse v⁺ - v⁻ is an unknown. In each phase u is linear in
/// t.
class BouncingBall final : public PhasedProblem {
 public:
  BouncingBall()
      : PhasedProblem({{"fall", std::make_shared<Flight>(at(1.0, 0.0), open(0.0, -4.0))},
                       {"rise", std::make_shared<Flight>(open(0.0, 3.0), at(1.1, 0.5))}},
                      {{"restitution", 0.7, "", "coefficient of restitution, 1 for an elastic impact", 0.0, 1.0},
                       {.name = "impulse", .value = 7.0, .unit = "N s", .meaning = "total impulse", .is_unknown = true},
                       horizon_parameter(1.2)}) {}

  [[nodiscard]] std::string name() const override { return "bouncing_ball"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = PhasedProblem::card();
    card.description = "ball with one bounce between given states, with least control effort";
    card.title = "Bouncing ball";
    card.axis_units = {.state = "m", .control = "N", .momentum = "N s", .cost = "N² s", .energy = "N m"};
    card.source = "a controlled impact in its simplest form, stated for this library";
    const double e = parameter("restitution");
    if (has_default_parameters({"restitution"}) && (e == 0.7 || e == 1.0)) {
      card.reference =
          ReferenceOptimum{.objective = e == 1.0 ? 10.258191327671888 : 13.578573105569905,
                           .digits = 16,
                           .certificate = "closed form of both phases, with two constants from Newton's method"};
    }
    return card;
  }

  [[nodiscard]] ExpressionVector link(std::size_t /*i*/, const PhaseEnd& before, const PhaseEnd& after) const override {
    return impact([](const ExpressionVector& q) { return q; }, varying("restitution"),
                  ExpressionVector{{varying("impulse")}}, before, after);
  }
  [[nodiscard]] ExpressionVector conditions(const std::vector<PhaseEnd>& /*first*/,
                                            const std::vector<PhaseEnd>& last) const override {
    return ExpressionVector{{last.back().t - parameter("horizon")}};
  }

 private:
  class Flight final : public PhaseBetween {
   public:
    Flight(End first, End last)
        : PhaseBetween(std::move(first), std::move(last), {0.05, 1000.0}, 0.6, {gravity_parameter(0.0)}) {}
    [[nodiscard]] std::string name() const override { return "flight"; }
    [[nodiscard]] ProblemCard card() const override { return {.configuration_units = {"m"}, .control_units = {"N"}}; }
    [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"height"}; }
    [[nodiscard]] std::vector<std::string> control_names() const override { return {"thrust"}; }
    [[nodiscard]] Expression lagrangian(const State& x) const override {
      return 0.5 * x.v[0] * x.v[0] - varying("gravity") * x.q[0];
    }
    [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
    [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }
  };

  static PhaseBetween::End at(double height, double velocity) {
    return {{.q = Eigen::VectorXd::Constant(1, height), .v = Eigen::VectorXd::Constant(1, velocity)}};
  }
  static PhaseBetween::End open(double height, double velocity) { return {at(height, velocity).state, true}; }
};

}  // namespace dmocbench
