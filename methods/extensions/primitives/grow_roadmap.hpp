#pragma once

#include <functional>

#include "methods/extensions/primitives/primitive_library.hpp"
#include "methods/extensions/primitives/stored_roadmap.hpp"

namespace dmocbench {

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
