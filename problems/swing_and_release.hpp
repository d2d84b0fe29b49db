#pragma once

#include <cmath>
#include <memory>

#include "methods/mechanics/phased_problem.hpp"
#include "problems/phase_between.hpp"

namespace dmocbench {

/// A mass swings on a rod, is let go, and flies to a target, with the least effort.
///
/// q = (x, z) in both phases, L = ½|q̇|² - gz, g = 9.81 m/s², mass 1 kg. On the rod of 1 m, g(q) = x² + z² - 1 = 0, a
/// torque drives the mass, in flight a force; C = ½|u|². From rest below the pivot to (3, -1) with any velocity after
/// 1.6 s; the time of the release is free.
class SwingAndRelease final : public PhasedProblem {
 public:
  SwingAndRelease() : PhasedProblem({{"swing", std::make_shared<Swing>()}, {"flight", std::make_shared<Flight>()}}) {}

  [[nodiscard]] std::string name() const override { return "swing_and_release"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = PhasedProblem::card();
    card.description = "swing on a rod and flight to a target, with least control effort";
    card.title = "Swing and release";
    card.axis_units = {.state = "m", .control = "N", .momentum = "N s", .cost = "N² s", .energy = "N m"};
    card.source = "a release from a constraint in its simplest form, stated for this library";
    card.reference = ReferenceOptimum{
        .objective = 20.23233163845,
        .digits = 12,
        .certificate = "the same problem in the angle of the rod, with Gauss with 3 stages on 128 and 256 intervals"};
    return card;
  }

  [[nodiscard]] ExpressionVector conditions(const std::vector<PhaseEnd>& /*first*/,
                                            const std::vector<PhaseEnd>& last) const override {
    return ExpressionVector{{last.back().t - 1.6}};
  }

 private:
  /// Both phases but for their forces.
  class Mass : public PhaseBetween {
   public:
    [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "z"}; }
    [[nodiscard]] Expression lagrangian(const State& x) const override {
      return 0.5 * (x.v[0] * x.v[0] + x.v[1] * x.v[1]) - 9.81 * x.q[1];
    }
    [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

   protected:
    Mass(End first, End last) : PhaseBetween(std::move(first), std::move(last), {0.1, 1.5}, 0.8) {}
    static constexpr double guessed_angle = 0.9;  // of the release
    static Eigen::Vector2d on_rod(double angle) { return {std::sin(angle), -std::cos(angle)}; }
  };

  class Swing final : public Mass {
   public:
    Swing()
        : Mass({BoundaryState::at_rest(on_rod(0.0))},
               {{.q = on_rod(guessed_angle), .v = Eigen::Vector2d(0.7, 0.9)}, true}) {}
    [[nodiscard]] std::string name() const override { return "swing"; }
    [[nodiscard]] ProblemCard card() const override {
      return {.configuration_units = {"m", "m"}, .control_units = {"N m"}};
    }
    [[nodiscard]] std::vector<std::string> control_names() const override { return {"torque"}; }
    [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
      const Expression square = x.q[0] * x.q[0] + x.q[1] * x.q[1];
      return ExpressionVector{{-x.u[0] * x.q[1] / square, x.u[0] * x.q[0] / square}};
    }
    [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
      return ExpressionVector{{q[0] * q[0] + q[1] * q[1] - 1.0}};
    }
    [[nodiscard]] MotionPoint guess(double t) const override {
      const double rate = guessed_angle / horizon();
      const Eigen::Vector2d q = on_rod(rate * t);
      return {.q = q, .v = rate * Eigen::Vector2d(-q[1], q[0]), .u = Eigen::VectorXd::Zero(1)};
    }
  };

  class Flight final : public Mass {
   public:
    Flight()
        : Mass({{.q = on_rod(guessed_angle), .v = Eigen::Vector2d(2.0, 1.0)}, true},
               {{.q = Eigen::Vector2d(3.0, -1.0), .v = Eigen::Vector2d(2.0, -1.0)}}) {}
    [[nodiscard]] std::string name() const override { return "flight"; }
    [[nodiscard]] ProblemCard card() const override {
      return {.configuration_units = {"m", "m"}, .control_units = {"N", "N"}};
    }
    [[nodiscard]] std::vector<std::string> control_names() const override { return {"force_x", "force_z"}; }
    [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
    [[nodiscard]] ProblemBounds bounds() const override {
      ProblemBounds bounds = Mass::bounds();
      bounds.last.v = Bounds::none(2);
      return bounds;
    }
  };
};

}  // namespace dmocbench
