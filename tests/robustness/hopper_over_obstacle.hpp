#pragma once

#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// The flight of a hopper: a body (5 kg, kept level by a flywheel) with a leg that swings and telescopes, a foot (0.5
/// kg) at its end. q = (x, z, θ, r), the hip, the leg's angle from the vertical and its length; u turns and stretches
/// the leg, C = |u|²/1000. The centre of mass flies as it was thrown; foot and leg must clear a hump in the middle (a
/// path constraint) and land 0.8 m ahead, the leg at its full length, when is free.
class HopperOverObstacle final : public SmallProblem {
 public:
  explicit HopperOverObstacle(double hump)
      : SmallProblem("hopper_over_obstacle", {at_takeoff(0.0), Eigen::Vector4d(1.2, 2.0, 0.0, 0.0)},
                     {at_takeoff(distance), Eigen::Vector4d(1.2, -2.0, 0.0, 0.0)}, 0.45, 2),
        hump_(hump) {}

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression along = x.v[0] + x.v[3] * sin(x.q[2]) + x.q[3] * cos(x.q[2]) * x.v[2];
    const Expression upward = x.v[1] - x.v[3] * cos(x.q[2]) + x.q[3] * sin(x.q[2]) * x.v[2];
    return 0.5 * body * (x.v[0] * x.v[0] + x.v[1] * x.v[1]) + 0.5 * foot * (along * along + upward * upward) -
           9.81 * (body * x.q[1] + foot * foot_height(x.q));
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{0.0, 0.0, x.u[0], x.u[1]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 1e-3 * x.u.dot(x.u); }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    const Expression off_centre = foot_place(x.q) - 0.5 * distance;
    return one(foot_height(x.q) - hump_ + 6.0 * hump_ * off_centre * off_centre / (distance * distance));
  }
  [[nodiscard]] ExpressionVector boundary_conditions(const State& /*first*/, const State& last) const override {
    return ExpressionVector{{foot_place(last.q) - distance, foot_height(last.q)}};
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    for (const Eigen::Index i : {0, 1, 2}) bounds.last.free_configuration(i);
    for (const Eigen::Index i : {0, 1}) bounds.last.free_velocity(i);
    bounds.q = Bounds::none(4);
    bounds.q.lower[3] = 0.3;
    bounds.q.upper[3] = leg;
    bounds.horizon = {0.2, 0.8};
    return bounds;
  }

 private:
  static constexpr double body = 5.0;      // kg
  static constexpr double foot = 0.5;      // kg
  static constexpr double leg = 0.6;       // m
  static constexpr double distance = 0.8;  // m

  static Eigen::VectorXd at_takeoff(double place) { return Eigen::Vector4d(place, leg, 0.0, leg); }
  static Expression foot_place(const ExpressionVector& q) { return q[0] + q[3] * sin(q[2]); }
  static Expression foot_height(const ExpressionVector& q) { return q[1] - q[3] * cos(q[2]); }

  double hump_;
};

}  // namespace dmocbench::tests
