#pragma once

#include <cmath>

#include "bench/experiments/invariants/example_systems.hpp"

namespace dmocbench {

/// `Kepler` with a thrust across q, f = u (-y, x)/|q|, which does work along the rotations ξ = (-y, x).
class KeplerEllipse : public Kepler {
 public:
  explicit KeplerEllipse(double eccentricity) : Kepler(eccentricity), eccentricity_(eccentricity) {}

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression thrust_by_radius = x.u[0] / sqrt(x.q.dot(x.q));
    return ExpressionVector{{-thrust_by_radius * x.q[1], thrust_by_radius * x.q[0]}};
  }
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    return ExpressionVector{{-q[1], q[0]}};
  }

  /// The unforced motion at time t, by Kepler's equation.
  [[nodiscard]] MotionPoint free_motion(double t) const {
    const double e = eccentricity_;
    double anomaly = t + e * std::sin(t);
    for (int i = 0; i < iterations; ++i) {
      anomaly -= (anomaly - e * std::sin(anomaly) - t) / (1.0 - e * std::cos(anomaly));
    }
    const double minor = std::sqrt(1.0 - e * e);
    const double rate = 1.0 / (1.0 - e * std::cos(anomaly));
    return {.q = Eigen::Vector2d(std::cos(anomaly) - e, minor * std::sin(anomaly)),
            .v = Eigen::Vector2d(-std::sin(anomaly), minor * std::cos(anomaly)) * rate,
            .u = Eigen::VectorXd::Zero(1)};
  }

 private:
  static constexpr int iterations = 20;
  double eccentricity_;
};

}  // namespace dmocbench
