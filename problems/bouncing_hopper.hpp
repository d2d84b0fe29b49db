#pragma once

#include <memory>

#include "methods/mechanics/phased_problem.hpp"
#include "problems/common_parameters.hpp"
#include "problems/phase_between.hpp"

namespace dmocbench {

/// A hopper on an asteroid with an uneven surface, which bounces once, with the least effort.
///
/// q = (r, φ), L = ½(ṙ² + r²φ̇²) + 1/r, f = (u_1 - 0.1 ṙ, r u_2 - 0.1 r²φ̇), C = ½|u|². From rest at (1.5, 0) to
/// (1.6, 1.2) with (0, 0.3) after T = 2.6; the impact on r = 1 + a cos 3φ, a = 0.15, has the coefficient of restitution
/// e. With a = 0 the impact keeps the angular momentum.
class BouncingHopper final : public PhasedProblem {
 public:
  BouncingHopper()
      : PhasedProblem(
            {{"down", std::make_shared<Flight>(at({1.5, 0.0}, {0.0, 0.0}), open({1.1, 0.4}, {-0.5, 0.5}), 1.1)},
             {"up", std::make_shared<Flight>(open({1.1, 0.4}, {0.5, 0.5}), at({1.6, 1.2}, {0.0, 0.3}), 1.5)}},
            {{"restitution", 1.0, "", "coefficient of restitution, 1 for an elastic impact", 0.0, 1.0},
             {"unevenness", 0.15, "", "unevenness a of the surface", 0.0, 0.3},
             {.name = "impulse", .value = 1.0, .unit = "", .meaning = "contact impulse", .is_unknown = true},
             {"horizon", 2.6, "", "duration T", 1e-3, 1e3}}) {}

  [[nodiscard]] std::string name() const override { return "bouncing_hopper"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = PhasedProblem::card();
    card.description = "hopper that bounces once on an uneven asteroid, with least control effort";
    card.title = "Bouncing hopper";
    card.axis_units = AxisUnits::pure_numbers();
    card.source = "an impact on a curved surface, stated for this library";
    const double e = parameter("restitution");
    const bool is_known = e == 1.0 || e == 0.6 || e == 0.0;
    if (is_known && has_default_parameters({"restitution"})) {
      card.reference = ReferenceOptimum{
          .objective = e == 1.0   ? 0.33974806686376
                       : e == 0.6 ? 0.42583077514461
                                  : 0.76833700307553,
          .digits = 14,
          .certificate = "indirect shooting over both phases and Gauss with 3 stages on 128 intervals agree"};
    }
    return card;
  }

  [[nodiscard]] ExpressionVector link(std::size_t /*i*/, const PhaseEnd& before, const PhaseEnd& after) const override {
    const auto height = [this](const ExpressionVector& q) {
      return ExpressionVector{{q[0] - 1.0 - varying("unevenness") * cos(3.0 * q[1])}};
    };
    return impact(height, varying("restitution"), ExpressionVector{{varying("impulse")}}, before, after);
  }
  [[nodiscard]] ExpressionVector conditions(const std::vector<PhaseEnd>& /*first*/,
                                            const std::vector<PhaseEnd>& last) const override {
    return ExpressionVector{{last.back().t - parameter("horizon")}};
  }

 private:
  class Flight final : public PhaseBetween {
   public:
    Flight(End first, End last, double duration)
        : PhaseBetween(std::move(first), std::move(last), {0.05, 1000.0}, duration) {}
    [[nodiscard]] std::string name() const override { return "flight"; }
    [[nodiscard]] ProblemCard card() const override { return {.time_unit = {.name = "", .factor = 1.0}}; }
    [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"r", "phi"}; }
    [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_r", "u_phi"}; }
    [[nodiscard]] Expression lagrangian(const State& x) const override {
      return 0.5 * (x.v[0] * x.v[0] + x.q[0] * x.q[0] * x.v[1] * x.v[1]) + 1.0 / x.q[0];
    }
    [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
      constexpr double drag = 0.1;
      return ExpressionVector{{x.u[0] - drag * x.v[0], x.q[0] * x.u[1] - drag * x.q[0] * x.q[0] * x.v[1]}};
    }
    [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }
    [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
      return ExpressionVector{{0.0, 1.0}};
    }
  };

  static PhaseBetween::End at(const Eigen::Vector2d& q, const Eigen::Vector2d& v) { return {{.q = q, .v = v}}; }
  static PhaseBetween::End open(const Eigen::Vector2d& q, const Eigen::Vector2d& v) { return {{.q = q, .v = v}, true}; }
};

}  // namespace dmocbench
