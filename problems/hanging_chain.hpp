#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The shape of a chain that hangs between two points, the chain of COPS.
///
/// q is the height over the horizontal coordinate, which takes the place of time: L = ½q̇², f = u, so that q̈ = u is
/// free; C = q √(1 + q̇²), the potential energy, with the length ∫ √(1 + q̇²) dt = 4. From (0, 1) to (1, 3), the slopes
/// at both ends free. The shape is a catenary.
///
/// Neither cost nor length reads the force, so that one number of every discrete motion is left open: with the stages
/// kept, the velocities of the nodes may change by (±1)^k δ, and the forces with them. A solve whose last Newton step
/// still moves along it is `not confirmed`; cost and price are right all the same.
class HangingChain final : public Problem {
 public:
  HangingChain()
      : Problem({{"length", 4.0, "", "length of the chain, larger than the distance between its ends", 2.25, 100.0}}) {}

  [[nodiscard]] std::string name() const override { return "hanging_chain"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card{
        .description = "chain of given length between two points, with least potential energy",
        .title = "Hanging chain",
        .source = "Dolan, More, Munson: Benchmarking optimization software with COPS 3.0, ANL/MCS-TM-273, problem 4",
        .guess = "the parabola of COPS, 4 |b - a| x (x/2 - 1/4) + a, without force",
        .time_unit = {.name = "", .factor = 1.0},
        .picture = [](const ControlledState& x) -> Picture {
          return {{"x", "", x.t}, {"height", "", x.q[0]}};
        }};
    if (has_default_parameters()) {
      card.reference =
          ReferenceOptimum{.objective = 5.06848011099341,
                           .digits = 14,
                           .certificate = "the catenary through both points, with two constants from Newton's method",
                           .published = {{5.06891, "COPS 3.0, N = 400"}, {5.068480, "PSOPT, example chain"}},
                           .remark = "the value of COPS is specific to its grid"};
    }
    return card;
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"height"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"bend"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.q[0] * stretch(x.v[0]); }
  [[nodiscard]] ExpressionVector integrands(const ControlledState& x) const override {
    return ExpressionVector{{stretch(x.v[0])}};
  }

  [[nodiscard]] BoundaryState initial_state() const override { return at(1.0, -2.0); }
  [[nodiscard]] BoundaryState final_state() const override { return at(3.0, 6.0); }
  [[nodiscard]] double horizon() const override { return 1.0; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.first.free_velocity(0);
    bounds.last.free_velocity(0);
    bounds.integrals = Bounds::all(1, parameter("length"), parameter("length"));
    return bounds;
  }
  [[nodiscard]] MotionPoint guess(double t) const override {
    return {.q = Eigen::VectorXd::Constant(1, 8.0 * t * (0.5 * t - 0.25) + 1.0),
            .v = Eigen::VectorXd::Constant(1, 8.0 * t - 2.0),
            .u = Eigen::VectorXd::Constant(1, 8.0)};
  }

 private:
  /// ds/dx.
  static Expression stretch(const Expression& slope) { return sqrt(1.0 + slope * slope); }
  static BoundaryState at(double height, double slope) {
    return {.q = Eigen::VectorXd::Constant(1, height), .v = Eigen::VectorXd::Constant(1, slope)};
  }
};

}  // namespace dmocbench
