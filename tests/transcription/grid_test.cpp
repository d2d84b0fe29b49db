#include "methods/transcription/motions/grid.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

Eigen::VectorXd nodes(std::initializer_list<double> entries) {
  return Eigen::Map<const Eigen::VectorXd>(entries.begin(), static_cast<Eigen::Index>(entries.size()));
}

TEST(Grid, UniformWidthsAreTheSameNumberOnEveryInterval) {
  // Differences of k/N would differ in their last digits, and so would the steps.
  for (const int count : {1, 3, 7, 10, 49, 1000}) {
    const Grid grid = Grid::uniform(count);
    ASSERT_EQ(grid.intervals(), static_cast<std::size_t>(count));
    EXPECT_TRUE((grid.relative_widths().array() == 1.0 / count).all()) << count;
  }
}

TEST(Grid, UniformNodesRunFromExactlyZeroToExactlyOne) {
  const Grid grid = Grid::uniform(49);
  ASSERT_EQ(grid.relative_times().size(), 50);
  EXPECT_EQ(grid.relative_times()[0], 0.0);
  EXPECT_EQ(grid.relative_times()[49], 1.0);
  for (Eigen::Index k = 0; k <= 49; ++k) {
    EXPECT_EQ(grid.relative_times()[k], static_cast<double>(k) / 49.0);
  }
}

TEST(Grid, FromNodesKeepsThemAndTakesTheirDifferences) {
  const Grid grid = Grid::from_nodes(nodes({0.0, 0.25, 0.375, 1.0}));
  EXPECT_EQ(grid.relative_times(), nodes({0.0, 0.25, 0.375, 1.0}));
  EXPECT_EQ(grid.relative_widths(), nodes({0.25, 0.125, 0.625}));
}

TEST(Grid, RefusesNumbersOfIntervalsOutOfRange) {
  EXPECT_THROW(static_cast<void>(Grid::uniform(0)), Error);
  EXPECT_THROW(static_cast<void>(Grid::uniform(-5)), Error);
  EXPECT_THROW(static_cast<void>(Grid::uniform(Grid::most_intervals + 1)), Error);
  EXPECT_THROW(static_cast<void>(Grid::uniform(std::numeric_limits<long long>::max())), Error);
}

TEST(Grid, RefusesNodesThatDoNotAscendStrictlyFromZeroToOne) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(static_cast<void>(Grid::from_nodes(Eigen::VectorXd())), Error);
  EXPECT_THROW(static_cast<void>(Grid::from_nodes(nodes({0.0}))), Error);
  EXPECT_THROW(static_cast<void>(Grid::from_nodes(nodes({0.0, 0.5}))), Error);
  EXPECT_THROW(static_cast<void>(Grid::from_nodes(nodes({0.1, 1.0}))), Error);
  EXPECT_THROW(static_cast<void>(Grid::from_nodes(nodes({0.0, 0.5, 0.5, 1.0}))), Error);
  EXPECT_THROW(static_cast<void>(Grid::from_nodes(nodes({0.0, 0.6, 0.5, 1.0}))), Error);
  EXPECT_THROW(static_cast<void>(Grid::from_nodes(nodes({0.0, nan, 1.0}))), Error);
  EXPECT_THROW(static_cast<void>(Grid::from_nodes(nodes({nan, 0.5, 1.0}))), Error);
}

TEST(Grid, RefusesAnIntervalSoNarrowThatRoundingDrownsTheMotion) {
  EXPECT_NO_THROW(static_cast<void>(Grid::from_nodes(nodes({0.0, 0.3, 0.3 + 2e-8, 1.0}))));
  for (const double width : {5e-9, 1e-11, 6e-17}) {
    tests::expect_error_naming({"1 and 2", "round-off"}, [&] {
      static_cast<void>(Grid::from_nodes(nodes({0.0, 0.3, 0.3 + width, 1.0})));
    });
  }
}

TEST(Grid, TakesNodesAtGivenTimesWithUniformPiecesBetweenThem) {
  const Grid grid = Grid::uniform(8).with_nodes_at({0.3, 0.9});
  ASSERT_EQ(grid.intervals(), 8U);
  EXPECT_EQ(grid.node_at(0.3), 2);
  EXPECT_EQ(grid.node_at(0.9), 7);
  for (Eigen::Index k = 0; k < 8; ++k) {
    EXPECT_NEAR(grid.relative_widths()[k], k < 2 ? 0.15 : k < 7 ? 0.12 : 0.1, 1e-15) << k;
  }
  EXPECT_EQ(Grid::uniform(7).with_nodes_at({}).relative_widths(), Grid::uniform(7).relative_widths());
}

TEST(Grid, StretchesAGradedGridInProportionAndMovesNoNodeThatIsThere) {
  const Grid graded = Grid::from_nodes(nodes({0.0, 0.1, 0.25, 0.5, 1.0}));
  EXPECT_LT((graded.with_nodes_at({0.25}).relative_times() - graded.relative_times()).norm(), 1e-15);
  const Eigen::VectorXd moved = nodes({0.0, 0.12, 0.3, 8.0 / 15.0, 1.0});
  EXPECT_LT((graded.with_nodes_at({0.3}).relative_times() - moved).norm(), 1e-15);
}

TEST(Grid, KeepsANodeForEachOfCrowdedTimes) {
  const Grid grid = Grid::uniform(4).with_nodes_at({0.97, 0.98, 0.99});
  EXPECT_LT((grid.relative_times() - nodes({0.0, 0.97, 0.98, 0.99, 1.0})).norm(), 1e-15);
  const Grid early = Grid::uniform(4).with_nodes_at({0.01, 0.02});
  EXPECT_EQ(early.node_at(0.01), 1);
  EXPECT_EQ(early.node_at(0.02), 2);
  tests::expect_error_naming({"3 times", "4 intervals"}, [] {
    static_cast<void>(Grid::uniform(3).with_nodes_at({0.1, 0.2, 0.3}));
  });
}

}  // namespace
}  // namespace dmocbench
