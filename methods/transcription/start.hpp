#pragma once

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/interpolation.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The program's vector sampled from a motion, the same way for every method: q and v at the nodes, p = L_v(q, v),
/// slopes of q at the stage times, slopes of p or v as mean slopes of the interval, u at the stage times. A free
/// horizon takes the motion's own; a motion of another horizon than the program's is stretched to it. Variables are
/// moved into their bounds.
[[nodiscard]] Eigen::VectorXd sample(Transcription& transcription, const Motion& motion);

/// The problem's own guess as a motion. The problem must outlive it.
[[nodiscard]] Motion guessed_motion(const Problem& problem);

}  // namespace dmocbench
