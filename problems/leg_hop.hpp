#pragma once

#include <memory>

#include "methods/mechanics/motion_constraints.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "problems/phase_between.hpp"

namespace dmocbench {

/// A body on a massive foot pushes itself off a floor that neither holds nor grips it without limit, and flies up.
///
/// q = (x, z, x_f, z_f): body (1 kg) and foot (0.2 kg), L = ½|v|² + 0.1|v_f|² - g(z + 0.2 z_f), g = 9.81 m/s². The leg
/// pushes with u the body and with -u the foot, C = ½|u|². In the stance the foot rests: g(q) = (x_f, -z_f) = 0, so
/// that the multipliers are (λ_t, λ_n) with the pressure λ_n >= 0 of the floor and friction |λ_t| <= μ λ_n, μ = 0.12.
/// From rest, 0.8 m above the foot, to the top of the flight, with the body at (0.4, 1.1) and
/// the foot at (0.4, 0.3), both at 0.6 m/s ahead, in 1 s; the time of the take-off is free.
class LegHop final : public PhasedProblem {
 public:
  static constexpr double gravity = 9.81;   ///< m/s²
  static constexpr double foot_mass = 0.2;  ///< kg
  static constexpr double friction = 0.12;  ///< the coefficient μ

  /// Both phases but for their bounds: body and foot with the force between them.
  class BodyAndFoot : public PhaseBetween {
   public:
    [[nodiscard]] ProblemCard card() const override {
      return {.configuration_units = {"m", "m", "m", "m"}, .control_units = {"N", "N"}};
    }
    [[nodiscard]] std::vector<std::string> configuration_names() const override {
      return {"x", "z", "x_foot", "z_foot"};
    }
    [[nodiscard]] std::vector<std::string> control_names() const override { return {"leg_x", "leg_z"}; }
    [[nodiscard]] Expression lagrangian(const State& x) const override {
      const Expression of_body = 0.5 * (x.v[0] * x.v[0] + x.v[1] * x.v[1]) - gravity * x.q[1];
      return of_body + foot_mass * (0.5 * (x.v[2] * x.v[2] + x.v[3] * x.v[3]) - gravity * x.q[3]);
    }
    [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
      return ExpressionVector{{x.u[0], x.u[1], -x.u[0], -x.u[1]}};
    }
    [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

   protected:
    using PhaseBetween::PhaseBetween;
  };

  /// On the floor.
  class Stance final : public BodyAndFoot {
   public:
    Stance()
        : BodyAndFoot({BoundaryState::at_rest(Eigen::Vector4d(0.0, 0.8, 0.0, 0.0))}, {take_off(), true}, {0.2, 0.95},
                      0.75) {}
    [[nodiscard]] std::string name() const override { return "stance"; }
    [[nodiscard]] ProblemCard card() const override {
      ProblemCard card = BodyAndFoot::card();
      card.path_constraint_names = {"pressure", "friction ahead", "friction back"};
      return card;
    }
    [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
      return ExpressionVector{{q[2], -q[3]}};
    }
    [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
      const ExpressionVector lambda = constraint_multipliers(*this, x);
      return ExpressionVector{{lambda[1], friction * lambda[1] - lambda[0], friction * lambda[1] + lambda[0]}};
    }
  };

  /// In the air.
  class Flight final : public BodyAndFoot {
   public:
    Flight()
        : BodyAndFoot({take_off(), true},
                      {{.q = Eigen::Vector4d(0.4, 1.1, 0.4, 0.3), .v = Eigen::Vector4d(0.6, 0.0, 0.6, 0.0)}},
                      {0.05, 0.8}, 0.25) {}
    [[nodiscard]] std::string name() const override { return "flight"; }
  };

  LegHop() : PhasedProblem({{"stance", std::make_shared<Stance>()}, {"flight", std::make_shared<Flight>()}}) {}

  [[nodiscard]] std::string name() const override { return "leg_hop"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = PhasedProblem::card();
    card.description = "take-off from a floor with pressure and friction, with least effort of the leg";
    card.title = "Hop with a leg";
    card.axis_units = {.state = "m", .control = "N", .momentum = "N s", .cost = "N² s", .energy = "N m"};
    card.source = "a contact with bounds on forces in its simplest form, stated for this library";
    card.reference = ReferenceOptimum{.objective = 77.3576451028,
                                      .digits = 12,
                                      .certificate =
                                          "tangent-space collocation with 2 Gauss stages and DMOC with 3 Lobatto "
                                          "stages, on 256 and 512 intervals, agree"};
    return card;
  }
  [[nodiscard]] ExpressionVector conditions(const std::vector<PhaseEnd>& /*first*/,
                                            const std::vector<PhaseEnd>& last) const override {
    return ExpressionVector{{last.back().t - 1.0}};
  }

 private:
  static BoundaryState take_off() {  // as guessed
    return {.q = Eigen::Vector4d(0.25, 0.9, 0.0, 0.0), .v = Eigen::Vector4d(0.7, 2.0, 0.0, 0.0)};
  }
};

}  // namespace dmocbench
