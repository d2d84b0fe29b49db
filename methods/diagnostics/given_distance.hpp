#pragma once

#include <string>

#include "methods/diagnostics/accuracy.hpp"
#include "methods/mechanics/bounds.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The size of the motion that a problem prescribes: the Euclidean norm, over all entries of (q, q̇), of the least
/// distance between the largest and the smallest value of an entry that both ends and the times between them allow. 0
/// where a motion may stay at rest.
[[nodiscard]] double given_distance(const ProblemBounds& bounds);

/// Why an answer that satisfies its program to the tolerance does not cover the given distance; empty where it does.
///
/// Tolerances are absolute: next to one of 1e-8 a body that stays at rest solves the program of a distance of 1e-9. So
/// a distance below `smallest_distance`, of 1 or of the largest |q|, has to show in the motion: its jumps
/// (`accuracy`), one per interval, and what its ends leave their bounds by must not add up to half of the distance. The
/// velocity at an end counts times the horizon.
[[nodiscard]] std::string lost_distance(const ProblemBounds& bounds, const Trajectory& motion,
                                        const Accuracy& accuracy);

/// See `lost_distance`.
inline constexpr double smallest_distance = 1e-6;

}  // namespace dmocbench
