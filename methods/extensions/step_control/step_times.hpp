#pragma once

#include <Eigen/Core>

#include "methods/extensions/step_control/extended_action.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

/// Node times of steps that are proportional to σ along a motion.
struct StepTimes {
  double pace = 0.0;      ///< Δτ = ∫ dt/σ / N
  Eigen::VectorXd times;  ///< t_0 = 0 .. t_N = T with ∫ dt/σ = Δτ from each to the next
};

/// Throws `Error` unless σ, met at time t, is positive and finite.
void require_positive_step(double sigma, double t);

/// Divides a motion into a given number of steps. The integral uses the trapezoidal rule with some thousand points:
/// exact to rounding over the period of a smooth motion. Throws `Error` if σ is not positive and finite along the
/// motion.
[[nodiscard]] StepTimes step_times(const StepFunction& sigma, const Motion& motion, Eigen::Index intervals);

}  // namespace dmocbench
