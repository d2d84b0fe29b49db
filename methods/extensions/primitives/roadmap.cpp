#include "methods/extensions/primitives/roadmap.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

constexpr double tolerance_of_nodes = 1e-8;
constexpr double unreachable = std::numeric_limits<double>::infinity();

void require_in_place(const PrimitiveLibrary& library, const std::vector<RoadmapNode>& nodes, const RoadmapEdge& edge) {
  const bool exists = edge.from < nodes.size() && edge.to < nodes.size() && edge.primitive < library.primitives.size();
  if (exists) {
    const Primitive& primitive = library.primitives[edge.primitive];
    const RoadmapNode& from = nodes[edge.from];
    const RoadmapNode& to = nodes[edge.to];
    if (from.state == primitive.first && to.state == primitive.last &&
        from.moved.after(primitive.displacement).distance(to.moved) <= tolerance_of_nodes) {
      return;
    }
  }
  throw Error("the edge of the roadmap from node {} to node {} does not have the same ends as its primitive {}",
              edge.from, edge.to, edge.primitive);
}

/// V(j, t) with the edge by which it is reached, for all nodes and time steps.
class CostTable {
 public:
  CostTable(const Roadmap& roadmap, std::size_t from, int duration)
      : roadmap_(roadmap),
        nodes_(roadmap.nodes().size()),
        values_(nodes_ * (static_cast<std::size_t>(duration) + 1), unreachable),
        edges_(values_.size()) {
    values_[from] = 0.0;
    for (int t = 0; t < duration; ++t) leave(t, duration);
  }

  [[nodiscard]] double at(std::size_t node, int t) const { return values_[place(node, t)]; }

  [[nodiscard]] RoadmapPath path_to(std::size_t node, int t) const {
    RoadmapPath path{.cost = at(node, t), .duration = t};
    while (t > 0) {
      const std::size_t edge = edges_[place(node, t)];
      path.edges.push_back(edge);
      t -= roadmap_.duration(edge);
      node = roadmap_.edges()[edge].from;
    }
    std::ranges::reverse(path.edges);
    return path;
  }

 private:
  [[nodiscard]] std::size_t place(std::size_t node, int t) const { return static_cast<std::size_t>(t) * nodes_ + node; }

  /// Takes all edges that leave at time step t.
  void leave(int t, int duration) {
    for (std::size_t node = 0; node < nodes_; ++node) {
      const double value = at(node, t);
      if (value == unreachable) continue;
      const auto [first, last] = roadmap_.leaving(node);
      for (std::size_t edge = first; edge < last; ++edge) {
        const int arrival = t + roadmap_.duration(edge);
        if (arrival > duration) continue;
        const std::size_t target = place(roadmap_.edges()[edge].to, arrival);
        const double cost = value + roadmap_.cost(edge);
        if (cost >= values_[target]) continue;
        values_[target] = cost;
        edges_[target] = edge;
      }
    }
  }

  const Roadmap& roadmap_;
  std::size_t nodes_;
  std::vector<double> values_;
  std::vector<std::size_t> edges_;
};

}  // namespace

Roadmap::Roadmap(const PrimitiveLibrary& library, std::vector<RoadmapNode> nodes, std::vector<RoadmapEdge> edges)
    : nodes_(std::move(nodes)), edges_(std::move(edges)), first_edge_(nodes_.size() + 1, 0) {
  for (const RoadmapEdge& edge : edges_) require_in_place(library, nodes_, edge);
  std::ranges::stable_sort(edges_, {}, &RoadmapEdge::from);
  for (const RoadmapEdge& edge : edges_) {
    ++first_edge_[edge.from + 1];
    const Primitive& primitive = library.primitives[edge.primitive];
    costs_.push_back(primitive.cost);
    durations_.push_back(primitive.duration);
  }
  for (std::size_t node = 0; node < nodes_.size(); ++node) first_edge_[node + 1] += first_edge_[node];
}

std::optional<RoadmapPath> cheapest_path(const Roadmap& roadmap, std::size_t from, std::size_t to, int duration) {
  if (std::max(from, to) >= roadmap.nodes().size()) {
    throw Error("the roadmap has {} nodes, numbered from 0: there is no path from node {} to node {}",
                roadmap.nodes().size(), from, to);
  }
  if (duration < 0) throw Error("a path cannot take {} time steps; the number must not be negative", duration);
  const CostTable table(roadmap, from, duration);
  if (table.at(to, duration) == unreachable) return std::nullopt;
  return table.path_to(to, duration);
}

}  // namespace dmocbench
