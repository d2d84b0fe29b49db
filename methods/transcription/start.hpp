#pragma once

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/interpolation.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The unknowns of a program sampled from a motion, by the same rules for every method: q and v at the nodes,
/// p = L_v(q, v), rates of q at the stage times, rates of p or v as mean rates of the interval, u at the stage times. A
/// free horizon becomes that of the motion; otherwise a motion with another horizon is stretched to the program's.
/// Variables are moved into their bounds.
[[nodiscard]] Eigen::VectorXd sample(Transcription& transcription, const Motion& motion);

/// The problem's own guess as a motion. The problem must outlive it.
[[nodiscard]] Motion guessed_motion(const Problem& problem);

}  // namespace dmocbench
