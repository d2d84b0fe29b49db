#pragma once

#include <cstddef>
#include <functional>

#include "methods/extensions/primitives/primitive_library.hpp"
#include "methods/extensions/primitives/roadmap.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// All that planning needs: built once, kept in a file, and used again and again.
struct StoredRoadmap {
  /// The primitives that its edges are made of.
  PrimitiveLibrary library;
  /// The graph.
  Roadmap roadmap;
  std::size_t start = 0;  ///< the node of the problem's first state
  std::size_t goal = 0;   ///< the node of its last state
};

/// The primitives of a path, each moved to where it begins, as one discrete motion by the midpoint rule on
/// duration · intervals_per_step equal intervals, without costates. Its cost equals the path's.
///
/// Where primitives meet they have one state, so the discrete equations hold at these nodes as they do inside: the
/// motion is a feasible point of DMOC's program on that grid. It is the start of a solve on any other grid too:
/// `sample(program, smooth_motion(trajectory))`. Throws `Error` if the path has no edges.
[[nodiscard]] Trajectory concatenate(const Problem& problem, const PrimitiveLibrary& library, const Roadmap& roadmap,
                                     const RoadmapPath& path);

/// The parameters of a roadmap that is grown.
struct GrowthRequest {
  /// The start of the paths.
  RoadmapNode start;
  /// The goal of the paths.
  RoadmapNode goal;
  int duration = 1;  ///< the horizon in time steps
  /// Nodes outside of a region are not visited; by default there is no such region.
  std::function<bool(const RoadmapNode& node)> may_visit = {};
};

/// The roadmap of all nodes and edges that lie on some way from the start to the goal within the horizon. From a node
/// every primitive leaves that begins in its state. Two nodes are one if their states are, and their configurations
/// agree to 1e-6 in every entry: primitives whose displacements lie on a lattice meet again. The group has to act
/// freely: the group element can be read from the moved configuration.
///
/// Of primitives that begin and end alike in the same time only the cheapest is used. Throws `Error` if the goal cannot
/// be reached.
[[nodiscard]] StoredRoadmap grow_roadmap(PrimitiveLibrary library, const GrowthRequest& request);

}  // namespace dmocbench
