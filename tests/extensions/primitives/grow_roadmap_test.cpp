#include <gtest/gtest.h>

#include "methods/extensions/primitives/stored_roadmap.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// One state that walks along a line: steps of 1/3 forward and back, and a jump of 1 that takes two time steps.
PrimitiveLibrary walk() {
  PrimitiveLibrary library;
  library.problem = "walk";
  library.states = {BoundaryState::at_rest(Eigen::VectorXd::Zero(1))};
  const auto add = [&](double shift, int duration, double cost) {
    library.primitives.push_back({.first = 0,
                                  .last = 0,
                                  .displacement = Displacement::translation(Eigen::VectorXd::Constant(1, shift)),
                                  .duration = duration,
                                  .cost = cost,
                                  .q = {},
                                  .v = {},
                                  .u = {}});
  };
  add(1.0 / 3.0, 1, 1.0);
  add(-1.0 / 3.0, 1, 1.0);
  add(1.0, 2, 2.5);
  add(1.0, 2, 9.0);
  return library;
}

RoadmapNode node_at(double q) {
  return {.state = 0, .moved = Displacement::translation(Eigen::VectorXd::Constant(1, q))};
}

TEST(GrowRoadmap, MeetsTheSameNodesAgainOnALattice) {
  const StoredRoadmap stored = grow_roadmap(walk(), {.start = node_at(0.0), .goal = node_at(2.0), .duration = 6});
  // Within six steps and back to the goal: from -1/3 (one step back, then two jumps) to 2 + 1/3.
  EXPECT_EQ(stored.roadmap.nodes().size(), 9U);
  const auto path = cheapest_path(stored.roadmap, stored.start, stored.goal, 6);
  ASSERT_TRUE(path);
  // Steps alone: two jumps would leave two time steps to walk forth and back.
  EXPECT_DOUBLE_EQ(path->cost, 6.0);
}

TEST(GrowRoadmap, UsesTheCheapestOfLikePrimitives) {
  const StoredRoadmap stored = grow_roadmap(walk(), {.start = node_at(0.0), .goal = node_at(1.0), .duration = 2});
  ASSERT_EQ(stored.roadmap.edges().size(), 1U);
  EXPECT_EQ(stored.roadmap.edges().front().primitive, 2U);
}

TEST(GrowRoadmap, StaysInItsRegion) {
  const auto may_visit = [](const RoadmapNode& node) { return node.moved.shift[0] > -0.1; };
  const StoredRoadmap stored =
      grow_roadmap(walk(), {.start = node_at(0.0), .goal = node_at(2.0), .duration = 6, .may_visit = may_visit});
  for (const RoadmapNode& node : stored.roadmap.nodes()) EXPECT_TRUE(may_visit(node));
}

TEST(GrowRoadmap, RefusesAGoalOutOfReach) {
  tests::expect_error_naming({"walk", "do not reach"}, [&] {
    static_cast<void>(grow_roadmap(walk(), {.start = node_at(0.0), .goal = node_at(2.0), .duration = 3}));
  });
}

}  // namespace
}  // namespace dmocbench
