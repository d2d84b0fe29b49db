#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// What `fit_forces` sets besides the multipliers of constraints.
enum class FittedForces : std::uint8_t {
  controls,     ///< the controls: for a start that moves the mechanism along x
  second_rates  ///< interior rates of p or v: for a discrete motion, whose controls are known
};

/// Sets multipliers, and what `with` names, by least squares to the rows of a program, which are linear in the
/// multipliers and mostly in the others. Newton's method started from no forces of constraint fails even from an
/// optimal motion. Variables stay within their bounds; a step after which the rows are not nearer to 0 is not taken.
void fit_forces(Transcription& program, FittedForces with, Eigen::VectorXd& x);

}  // namespace dmocbench
