#pragma once

#include <cmath>
#include <numbers>

#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// A spacecraft between Earth and Moon in the frame that turns with them, units in which their distance, the sum of
/// their masses and the rate of the frame are 1:
///   L = ½|v|² + x ẏ - y ẋ + ½|q|² + (1 - μ)/r₁ + μ/r₂,
/// linear terms in v included. From a circle of radius 0.4 about the Earth to one of radius 0.1 about the Moon, C =
/// ½|u|².
class EarthMoonTransfer final : public SmallProblem {
 public:
  EarthMoonTransfer()
      : SmallProblem("earth_moon_transfer", on_circle(-moon, 1.0 - moon, 0.4, -0.5 * std::numbers::pi),
                     on_circle(1.0 - moon, moon, 0.1, std::numbers::pi), 3.0, 2) {}

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression turning = x.q[0] * x.v[1] - x.q[1] * x.v[0];
    return 0.5 * x.v.dot(x.v) + turning + 0.5 * x.q.dot(x.q) + (1.0 - moon) / distance(x.q, -moon) +
           moon / distance(x.q, 1.0 - moon);
  }
  /// Round the Earth on a spiral, radius and angle on straight lines.
  [[nodiscard]] MotionPoint guess(double t) const override {
    const double part = t / horizon();
    const double radius = 0.4 + part * 0.5;
    const double angle = -0.5 * std::numbers::pi * (1.0 - part) + 2.0 * std::numbers::pi * part;
    const Eigen::Vector2d outward(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d around(-outward[1], outward[0]);
    return {.q = Eigen::Vector2d(-moon, 0.0) + radius * outward,
            .v = (0.5 * outward + radius * 2.5 * std::numbers::pi * around) / horizon(),
            .u = Eigen::Vector2d::Zero()};
  }

 private:
  static constexpr double moon = 0.01215;  // its share μ of the mass

  /// Counterclockwise on a circle about a body, as the turning frame sees it.
  static BoundaryState on_circle(double centre, double mass, double radius, double angle) {
    const Eigen::Vector2d outward(std::cos(angle), std::sin(angle));
    const double rate = std::sqrt(mass / radius) - radius;
    return {Eigen::Vector2d(centre, 0.0) + radius * outward, rate * Eigen::Vector2d(-outward[1], outward[0])};
  }
  static Expression distance(const ExpressionVector& q, double centre) {
    const Expression along = q[0] - centre;
    return sqrt(along * along + q[1] * q[1]);
  }
};

}  // namespace dmocbench::tests
