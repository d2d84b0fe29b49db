#pragma once

#include "methods/extensions/primitives/primitive_library.hpp"
#include "methods/extensions/primitives/roadmap.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The primitives of a path, each moved to where it begins, as one discrete motion by the midpoint rule on
/// duration · intervals_per_step equal intervals, without costates. Its cost equals the path's.
///
/// Where primitives meet they have one state, so the discrete equations hold at these nodes as they do inside: the
/// motion is a feasible point of DMOC's program on that grid. It is the start of a solve on any other grid too:
/// `sample(program, smooth_motion(trajectory))`. Throws `Error` if the path has no edges.
[[nodiscard]] Trajectory concatenate(const Problem& problem, const PrimitiveLibrary& library, const Roadmap& roadmap,
                                     const RoadmapPath& path);

}  // namespace dmocbench
