#pragma once

#include <cmath>
#include <memory>

#include "methods/mechanics/phased_problem.hpp"
#include "problems/phase_between.hpp"

namespace dmocbench {

/// The fastest descent across two fields of gravity: the brachistochrone with a refraction.
///
/// q = (x, d), d the depth, L = ½|q̇|² + gd with g = 9.81 m/s² above d = 1 m and 3 m/s² below, f = u(-ḋ, ẋ) (the wire,
/// which does no work), minimise T from rest at (0, 0) to (2, 2), final velocity free. The optimum consists of two arcs
/// of cycloids with one constant in sin θ = K |q̇|, Snell's law. As of `Brachistochrone`, the whole optimum is a
/// singular arc; with one Gauss stage the control of the first interval of each phase does not converge, states and T
/// do.
class Refraction final : public PhasedProblem {
 public:
  Refraction()
      : PhasedProblem({{"upper", std::make_shared<Fall>(9.81, at(0.0, 0.0), open(0.7, 1.0), true)},
                       {"lower", std::make_shared<Fall>(3.0, open(0.7, 1.0), at(2.0, 2.0), false)}}) {}

  [[nodiscard]] std::string name() const override { return "refraction"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = PhasedProblem::card();
    card.description = "fastest descent across two fields of gravity, controlled by the wire's reaction; free horizon";
    card.title = "Brachistochrone with refraction";
    card.axis_units = {.state = "m", .control = "1/s", .momentum = "m/s", .cost = "s"};
    card.source = "Johann Bernoulli 1696, with a second medium";
    card.reference = ReferenceOptimum{.objective = 0.86820690564808470,
                                      .digits = 16,
                                      .certificate = "closed form, two arcs of cycloids and Snell's law",
                                      .remark = "use Gauss tableaus to certify, as for brachistochrone"};
    return card;
  }

 private:
  class Fall final : public PhaseBetween {
   public:
    Fall(double gravity, End first, End last, bool is_upper)
        : PhaseBetween(std::move(first), std::move(last), {0.05, 10.0}, is_upper ? 0.55 : 0.35),
          gravity_(gravity),
          is_upper_(is_upper) {}
    [[nodiscard]] std::string name() const override { return "fall"; }
    [[nodiscard]] ProblemCard card() const override {
      return {.configuration_units = {"m", "m"}, .control_units = {"1/s"}};
    }
    [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "depth"}; }
    [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }
    [[nodiscard]] Expression lagrangian(const State& x) const override {
      return 0.5 * (x.v[0] * x.v[0] + x.v[1] * x.v[1]) + gravity_ * x.q[1];
    }
    [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
      return ExpressionVector{{-x.u[0] * x.v[1], x.u[0] * x.v[0]}};
    }
    [[nodiscard]] Expression running_cost(const ControlledState& /*x*/) const override { return 0.0; }
    [[nodiscard]] Expression final_cost(const State& last) const override { return last.t; }
    [[nodiscard]] ProblemBounds bounds() const override {
      ProblemBounds bounds = PhaseBetween::bounds();
      if (is_upper_) {
        bounds.last.q.lower[1] = bounds.last.q.upper[1] = final_state().q[1];
      } else {
        bounds.last.v = Bounds::none(2);
      }
      return bounds;
    }
    /// A slide down a straight wire, from rest in the upper field.
    [[nodiscard]] MotionPoint guess(double t) const override {
      const Eigen::Vector2d way = final_state().q - initial_state().q;
      const double tau = t / horizon();
      const double place = is_upper_ ? tau * tau : tau;
      const double speed = (is_upper_ ? 2.0 * tau : 1.0) / horizon();
      return {.q = initial_state().q + place * way, .v = speed * way, .u = Eigen::VectorXd::Constant(1, -1.0)};
    }

   private:
    double gravity_;
    bool is_upper_;
  };

  static PhaseBetween::End at(double x, double depth) { return {BoundaryState::at_rest(Eigen::Vector2d(x, depth))}; }
  static PhaseBetween::End open(double x, double depth) { return {at(x, depth).state, true}; }
};

}  // namespace dmocbench
