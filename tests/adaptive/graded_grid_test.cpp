#include "methods/adaptive/graded_grid.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

double largest_ratio_of(const Grid& grid) {
  const Eigen::VectorXd& widths = grid.relative_widths();
  double largest = 1.0;
  for (Eigen::Index k = 1; k < widths.size(); ++k) {
    largest = std::max({largest, widths[k] / widths[k - 1], widths[k - 1] / widths[k]});
  }
  return largest;
}

/// Wishes that jump by a factor of a million.
Eigen::VectorXd torn_wishes(const Grid& grid) {
  Eigen::VectorXd wished = grid.relative_widths();
  wished[grid.relative_widths().size() / 3] *= 1e-6;
  return wished;
}

TEST(GradedGrid, KeepsEvenWishesUniform) {
  const Grid grid = graded_grid(Grid::uniform(7), Eigen::VectorXd::Constant(7, 1.0 / 20.0), 2.0);
  EXPECT_EQ(grid.intervals(), 20U);
  EXPECT_LT((grid.relative_times() - Grid::uniform(20).relative_times()).norm(), 1e-14);
}

TEST(GradedGrid, LetsNoStepBeMoreThanTheRatioTimesAsWideAsItsNeighbour) {
  for (const double ratio : {1.1, 1.5, 2.0, 4.0}) {
    const Grid grid = Grid::uniform(30);
    EXPECT_LE(largest_ratio_of(graded_grid(grid, torn_wishes(grid), ratio)), ratio * (1.0 + 1e-9)) << ratio;
  }
}

TEST(GradedGrid, HasNoStepWiderThanWished) {
  const Grid grid = Grid::uniform(30);
  const Eigen::VectorXd wished = torn_wishes(grid);
  const Grid graded = graded_grid(grid, wished, 1.5);
  for (Eigen::Index k = 0; k < graded.relative_widths().size(); ++k) {
    EXPECT_LE(graded.relative_widths()[k], wished.maxCoeff() * (1.0 + 1e-12));
    const double middle = 0.5 * (graded.relative_times()[k] + graded.relative_times()[k + 1]);
    const double distance = std::abs(middle - (10.0 + 0.5) / 30.0);  // from the middle of the narrow wish
    EXPECT_LE(graded.relative_widths()[k], 1.5 * (wished.minCoeff() + std::log(1.5) * distance) + 1e-9);
  }
}

TEST(GradedGrid, RefusesWishesThatAreNoWidths) {
  const Grid grid = Grid::uniform(4);
  tests::expect_error_naming({"positive"},
                             [&] { static_cast<void>(graded_grid(grid, Eigen::Vector4d(0.1, 0.0, 0.1, 0.1), 2.0)); });
  tests::expect_error_naming({"positive"},
                             [&] { static_cast<void>(graded_grid(grid, Eigen::Vector3d(0.1, 0.1, 0.1), 2.0)); });
}

TEST(EquidistributedWidths, SpreadTheDefectsOfAPowerLawEvenlyAndReduceTheirSum) {
  // d(h, t) = c(t) h^5 with a c that varies by e^4; a fine grid, so that c is constant in an interval.
  const Grid grid = Grid::uniform(400);
  const auto factor = [](double t) { return std::exp(4.0 * t); };
  const auto defects_on = [&](const Grid& any) {
    Eigen::VectorXd defects(any.relative_widths().size());
    for (Eigen::Index k = 0; k < defects.size(); ++k) {
      defects[k] = factor(0.5 * (any.relative_times()[k] + any.relative_times()[k + 1])) *
                   std::pow(any.relative_widths()[k], 5.0);
    }
    return defects;
  };
  const Eigen::VectorXd before = defects_on(grid);
  const Grid even = graded_grid(grid, equidistributed_widths(grid, before, 4, 0.5, 1e6).widths, 2.0);
  const Eigen::VectorXd after = defects_on(even);
  EXPECT_LT(after.maxCoeff() / after.minCoeff(), 1.05);
  EXPECT_NEAR(after.sum() / before.sum(), 0.5, 0.02);
}

TEST(EquidistributedWidths, KeepTheirProportionsWhereTheNumberOfIntervalsIsLimited) {
  const Grid grid = Grid::uniform(3);
  const Eigen::Vector3d defects(1.0, 8.0, 27.0);
  const EvenWidths limited = equidistributed_widths(grid, defects, 2, 1e-9, 6.0);
  EXPECT_GT(limited.asked, 1000.0);
  EXPECT_NEAR(grid.relative_widths().cwiseQuotient(limited.widths).sum(), 6.0, 1e-9);
  EXPECT_NEAR(limited.widths[0] / limited.widths[1], 2.0, 1e-9);
  EXPECT_NEAR(limited.widths[0] / limited.widths[2], 3.0, 1e-9);
}

TEST(EquidistributedWidths, AreHalvedWhereADefectIsUnknownAndWideWhereThereIsNone) {
  const Grid grid = Grid::uniform(4);
  Eigen::Vector4d defects = Eigen::Vector4d::Ones();
  defects[2] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(equidistributed_widths(grid, defects, 2, 0.1, 100.0).widths, Eigen::VectorXd(0.5 * grid.relative_widths()));
  EXPECT_EQ(equidistributed_widths(grid, Eigen::Vector4d::Zero(), 2, 0.1, 100.0).widths,
            Eigen::VectorXd(4.0 * grid.relative_widths()));
}

}  // namespace
}  // namespace dmocbench
