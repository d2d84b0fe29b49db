#pragma once

#include <cstddef>

#include "methods/extensions/primitives/primitive_library.hpp"
#include "methods/extensions/primitives/roadmap.hpp"

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

}  // namespace dmocbench
