#pragma once

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The largest violation of the bounds on q, q̇ and u and of h >= 0 between the points of a transcription. A program
/// imposes them at nodes (q) and stages (q̇, u, h) only.
///
/// The motion is the element's polynomial of q with its time derivative, and the stage polynomial of u, evaluated at 16
/// points per interval. Infinity where h is not a number; 0 where the problem has no such bounds or constraints.
[[nodiscard]] double violation_between_nodes(const Problem& problem, const Trajectory& trajectory);

}  // namespace dmocbench
