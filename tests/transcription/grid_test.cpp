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
    tests::expect_error_naming({"1 and 2", "rounding"}, [&] {
      static_cast<void>(Grid::from_nodes(nodes({0.0, 0.3, 0.3 + width, 1.0})));
    });
  }
}

}  // namespace
}  // namespace dmocbench
