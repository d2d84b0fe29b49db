#pragma once

#include <cmath>
#include <memory>

#include "methods/mechanics/phased_problem.hpp"
#include "problems/common_parameters.hpp"
#include "problems/phase_between.hpp"

namespace dmocbench {

/// A periodic step of a walker of two straight legs, with the least effort: the compass gait.
///
/// q = (θ_1, θ_2), the angles of the stance and the swing leg from the vertical; a mass m_H = 2 kg at the hip, m = 1 kg
/// in the middle of each leg of 1 m, g = 9.81 m/s². Torques act at the hip and at the ankle of the stance leg, C = 0.05
/// |u|². The step of 0.5 m on level ground has a free duration. At its end the swing foot lands and stays, the old
/// stance foot leaves, and the legs exchange their names.
class CompassGait final : public PhasedProblem {
 public:
  CompassGait()
      : PhasedProblem({{"step", std::make_shared<Step>()}}, {{"length", 0.5, "m", "length of the step", 0.05, 1.0}}) {}

  [[nodiscard]] std::string name() const override { return "compass_gait"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = PhasedProblem::card();
    card.description = "periodic step of a two-legged walker with least torque and free duration";
    card.title = "Compass gait";
    card.axis_units = {.state = "rad", .control = "N m", .momentum = "N m s", .cost = "N² m² s", .energy = "N m"};
    card.source =
        "Goswami, Espiau, Keramane: Limit cycles in a passive compass gait biped, with two torques; the step and its "
        "data are stated for this library";
    card.reference = with_default_parameters(
        *this, {.objective = 0.052586249351195,
                .digits = 13,
                .certificate = "indirect shooting of the step and Gauss with 3 stages on 128 intervals agree"});
    return card;
  }

  /// The step is periodic: its first state is the one after the foot of its last state has landed.
  [[nodiscard]] ExpressionVector conditions(const std::vector<PhaseEnd>& first,
                                            const std::vector<PhaseEnd>& last) const override {
    const auto landed = [this](const ExpressionVector& q) {
      return ExpressionVector{{varying("length") + sin(q[0]) - sin(q[1]), cos(q[0]) - cos(q[1]), q[1], q[0]}};
    };
    const auto held = [](const ExpressionVector& q) { return ExpressionVector{{0.0, 0.0, q[0], q[1]}}; };
    return new_foothold({whole_body, held, landed}, last[0], first[0]);
  }

 private:
  /// L of (x, y, θ_1, θ_2), with (x, y) the foot of leg 1.
  static Expression whole_body(const State& body) {
    constexpr double hip_mass = 2.0;
    constexpr double leg_mass = 1.0;
    constexpr double gravity = 9.81;
    struct Direction {
      Expression x, y, x_rate, y_rate;
    };
    const auto along = [&](Eigen::Index i) {
      const Expression angle = body.q[i];
      return Direction{sin(angle), cos(angle), cos(angle) * body.v[i], -sin(angle) * body.v[i]};
    };
    const auto mass_at = [&](double mass, double on_first, double on_second) {
      const Direction first = along(2);
      const Direction second = along(3);
      const Expression x_rate = body.v[0] + on_first * first.x_rate - on_second * second.x_rate;
      const Expression y_rate = body.v[1] + on_first * first.y_rate - on_second * second.y_rate;
      const Expression height = body.q[1] + on_first * first.y - on_second * second.y;
      return mass * (0.5 * (x_rate * x_rate + y_rate * y_rate) - gravity * height);
    };
    return mass_at(leg_mass, 0.5, 0.0) + mass_at(hip_mass, 1.0, 0.0) + mass_at(leg_mass, 1.0, 0.5);
  }

  class Step final : public PhaseBetween {
   public:
    Step() : PhaseBetween(open(-0.25, 0.25), open(0.25, -0.25), {0.2, 2.0}, 0.7) {}
    [[nodiscard]] std::string name() const override { return "step"; }
    [[nodiscard]] ProblemCard card() const override {
      return {.configuration_units = {"rad", "rad"}, .control_units = {"N m", "N m"}};
    }
    [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"stance", "swing"}; }
    [[nodiscard]] std::vector<std::string> control_names() const override { return {"hip", "ankle"}; }
    [[nodiscard]] Expression lagrangian(const State& x) const override {
      return whole_body(
          {ExpressionVector{{0.0, 0.0, x.q[0], x.q[1]}}, ExpressionVector{{0.0, 0.0, x.v[0], x.v[1]}}, x.t});
    }
    [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
      return ExpressionVector{{x.u[1] - x.u[0], x.u[0]}};
    }
    [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.05 * x.u.dot(x.u); }

   private:
    static End open(double stance, double swing) {
      return {{.q = Eigen::Vector2d(stance, swing), .v = Eigen::Vector2d(0.7, -0.7)}, true};
    }
  };
};

}  // namespace dmocbench
