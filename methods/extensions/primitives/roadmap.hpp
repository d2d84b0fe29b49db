#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "methods/extensions/primitives/primitive_library.hpp"
#include "methods/extensions/primitives/symmetry_group.hpp"

namespace dmocbench {

/// A state of a library, moved by an element of the group.
struct RoadmapNode {
  std::size_t state = 0;  ///< in `PrimitiveLibrary::states`
  Displacement moved;     ///< the identity where there is no symmetry
};

/// A primitive between two nodes; it is moved as its first node is.
struct RoadmapEdge {
  /// The node where it begins.
  std::size_t from = 0;
  /// The node where it ends.
  std::size_t to = 0;
  std::size_t primitive = 0;  ///< in `PrimitiveLibrary::primitives`
};

/// A directed graph whose edges are primitives: where motions may go.
class Roadmap {
 public:
  /// The edges are kept in the order of their first nodes. Throws `Error` if an edge does not begin and end where its
  /// primitive does, to 1e-8 in every entry of the displacement.
  Roadmap(const PrimitiveLibrary& library, std::vector<RoadmapNode> nodes, std::vector<RoadmapEdge> edges);

  /// All nodes; an edge names them by their place here.
  [[nodiscard]] const std::vector<RoadmapNode>& nodes() const noexcept { return nodes_; }
  /// All edges, sorted by the node where they begin.
  [[nodiscard]] const std::vector<RoadmapEdge>& edges() const noexcept { return edges_; }
  /// The numbers of the edges that leave a node: from first to last - 1.
  struct EdgeRange {
    /// Number of the first edge.
    std::size_t first = 0;
    /// One past the last number.
    std::size_t last = 0;
  };
  /// The edges that begin at a node.
  [[nodiscard]] EdgeRange leaving(std::size_t node) const { return {first_edge_[node], first_edge_[node + 1]}; }
  /// Cost and duration, in time steps, of an edge.
  [[nodiscard]] double cost(std::size_t edge) const { return costs_[edge]; }
  /// The duration of an edge, in steps.
  [[nodiscard]] int duration(std::size_t edge) const { return durations_[edge]; }

 private:
  std::vector<RoadmapNode> nodes_;
  std::vector<RoadmapEdge> edges_;
  std::vector<std::size_t> first_edge_;  // of every node, and one more
  std::vector<double> costs_;
  std::vector<int> durations_;
};

/// Edges of a roadmap one after the other.
struct RoadmapPath {
  std::vector<std::size_t> edges = {};  ///< numbers in `Roadmap::edges`
  double cost = 0.0;                    ///< the sum of their costs
  int duration = 0;                     ///< the sum of their durations, in time steps
};

/// The path of least cost from one node to another that takes exactly `duration` time steps, by dynamic programming:
///   V(j, t) = min over the edges e = (i, j) of V(i, t - duration(e)) + cost(e),  V(from, 0) = 0.
/// Costs may be negative. None if there is no path. Takes of the order of (edges · duration) operations. Throws `Error`
/// if a node does not exist or the duration is negative.
[[nodiscard]] std::optional<RoadmapPath> cheapest_path(const Roadmap& roadmap, std::size_t from, std::size_t to,
                                                       int duration);

}  // namespace dmocbench
