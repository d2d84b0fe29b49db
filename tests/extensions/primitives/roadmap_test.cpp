#include "methods/extensions/primitives/roadmap.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// A graph without motions: every edge has a primitive of its own between two of `nodes` states.
struct BareGraph {
  PrimitiveLibrary library;
  std::vector<RoadmapNode> nodes;
  std::vector<RoadmapEdge> edges;

  explicit BareGraph(std::size_t count) {
    for (std::size_t node = 0; node < count; ++node) {
      library.states.push_back(BoundaryState::at_rest(Eigen::VectorXd::Zero(1)));
      nodes.push_back({.state = node, .moved = Displacement::identity(1)});
    }
  }
  void connect(std::size_t from, std::size_t to, int duration, double cost) {
    edges.push_back({.from = from, .to = to, .primitive = library.primitives.size()});
    library.primitives.push_back({.first = from,
                                  .last = to,
                                  .displacement = Displacement::identity(1),
                                  .duration = duration,
                                  .cost = cost,
                                  .q = {},
                                  .v = {},
                                  .u = {}});
  }
  [[nodiscard]] Roadmap roadmap() const { return {library, nodes, edges}; }
};

/// Edges at random, some of them with negative costs.
BareGraph random_graph(std::mt19937& random, std::size_t nodes, int edges) {
  std::uniform_int_distribution<std::size_t> node(0, nodes - 1);
  std::uniform_int_distribution<int> duration(1, 3);
  std::uniform_real_distribution<double> cost(-0.2, 1.0);
  BareGraph graph(nodes);
  for (int edge = 0; edge < edges; ++edge) graph.connect(node(random), node(random), duration(random), cost(random));
  return graph;
}

/// The least cost of all paths, each of them tried.
double least_of_all(const Roadmap& roadmap, std::size_t node, std::size_t goal, int duration) {
  double least = node == goal && duration == 0 ? 0.0 : std::numeric_limits<double>::infinity();
  const auto [first, last] = roadmap.leaving(node);
  for (std::size_t edge = first; edge < last; ++edge) {
    if (roadmap.duration(edge) > duration) continue;
    const double rest = least_of_all(roadmap, roadmap.edges()[edge].to, goal, duration - roadmap.duration(edge));
    least = std::min(least, roadmap.cost(edge) + rest);
  }
  return least;
}

/// Whether the edges follow each other from `from` to `to` and add up to what the path tells of them.
void expect_to_be_a_path(const Roadmap& roadmap, const RoadmapPath& path, std::size_t from, std::size_t to) {
  double cost = 0.0;
  int duration = 0;
  for (const std::size_t edge : path.edges) {
    EXPECT_EQ(roadmap.edges()[edge].from, from);
    from = roadmap.edges()[edge].to;
    cost += roadmap.cost(edge);
    duration += roadmap.duration(edge);
  }
  EXPECT_EQ(from, to);
  EXPECT_EQ(duration, path.duration);
  EXPECT_NEAR(cost, path.cost, 1e-12);
}

TEST(CheapestPath, IsTheBestOfAllPathsOnSmallGraphs) {
  std::mt19937 random(7);
  int found = 0;
  for (int graph = 0; graph < 200; ++graph) {
    const Roadmap roadmap = random_graph(random, 5, 12).roadmap();
    const double least = least_of_all(roadmap, 0, 4, 7);
    const auto path = cheapest_path(roadmap, 0, 4, 7);
    ASSERT_EQ(path.has_value(), std::isfinite(least)) << graph;
    if (!path) continue;
    ++found;
    EXPECT_NEAR(path->cost, least, 1e-12) << graph;
    EXPECT_EQ(path->duration, 7) << graph;
    expect_to_be_a_path(roadmap, *path, 0, 4);
  }
  EXPECT_GT(found, 100);
}

TEST(CheapestPath, TakesTheDearEdgeWhereTheCheapOneIsTooSlow) {
  BareGraph graph(3);
  graph.connect(0, 1, 5, 0.1);
  graph.connect(0, 1, 2, 3.0);
  graph.connect(1, 2, 1, 1.0);
  const Roadmap roadmap = graph.roadmap();
  EXPECT_DOUBLE_EQ(cheapest_path(roadmap, 0, 2, 6)->cost, 1.1);
  EXPECT_DOUBLE_EQ(cheapest_path(roadmap, 0, 2, 3)->cost, 4.0);
  EXPECT_EQ(cheapest_path(roadmap, 0, 2, 5), std::nullopt);
}

TEST(CheapestPath, RefusesNodesThatDoNotExist) {
  const Roadmap roadmap = BareGraph(2).roadmap();
  tests::expect_error_naming({"2 nodes"}, [&] { static_cast<void>(cheapest_path(roadmap, 0, 2, 1)); });
  tests::expect_error_naming({"must not be negative"}, [&] { static_cast<void>(cheapest_path(roadmap, 0, 1, -1)); });
}

TEST(Roadmap, RefusesAnEdgeThatEndsElsewhereThanItsPrimitive) {
  BareGraph graph(2);
  graph.connect(0, 1, 1, 1.0);
  graph.nodes[1].moved.shift[0] = 0.5;
  tests::expect_error_naming({"same ends"}, [&] { static_cast<void>(graph.roadmap()); });
  graph.nodes[1].moved.shift[0] = 0.0;
  graph.edges.front().to = 0;
  tests::expect_error_naming({"same ends"}, [&] { static_cast<void>(graph.roadmap()); });
}

}  // namespace
}  // namespace dmocbench
