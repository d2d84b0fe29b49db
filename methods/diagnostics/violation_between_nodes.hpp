#pragma once

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/trajectory.hpp"

namespace dmocbench {

/// Largest amount by which the motion between the points of a transcription leaves what the problem prescribes: bounds
/// on q, q̇ and u and h >= 0. A program imposes them at nodes (q) and stages (q̇, u, h) only.
///
/// The motion is the element's own polynomial of q with its slope, and the stage polynomial of u, looked at in 16
/// points per interval. Infinity where h is not a number; 0 where the problem prescribes nothing of this kind.
[[nodiscard]] double violation_between_nodes(const Problem& problem, const Trajectory& trajectory);

}  // namespace dmocbench
