#include "methods/solvers/sqp/quadratic/pricing.hpp"

#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace dmocbench::sqp {
namespace {

const std::vector<PricedColumn> candidates{{2, -1.0}, {5, 4.0}, {7, -6.0}, {9, 3.0}};

TEST(Pricing, FollowsItsRule) {
  EXPECT_EQ(Pricing(PricingRule::largest).choose(candidates).column, 7);
  EXPECT_EQ(Pricing(PricingRule::lowest).choose(candidates).column, 2);
  EXPECT_EQ(Pricing(PricingRule::last).choose(candidates).column, 9);
}

TEST(Pricing, AtRandomRepeatsWithItsSeedAndReachesAll) {
  Pricing first(PricingRule::random, 5);
  Pricing second(PricingRule::random, 5);
  std::set<Eigen::Index> reached;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Index column = first.choose(candidates).column;
    EXPECT_EQ(column, second.choose(candidates).column);
    reached.insert(column);
  }
  EXPECT_EQ(reached.size(), candidates.size());
}

constexpr double no_bound = std::numeric_limits<double>::infinity();
constexpr double tolerance = 1e-9;

TEST(RatioTest, StopsAtTheFirstBound) {
  const RatioTest test =
      ratio_test({{0.0, 1.0, -1.0, 3.0}, {0.0, -2.0, -1.0, 3.0}, {0.0, 0.1, -1.0, 3.0}}, no_bound, tolerance);
  EXPECT_EQ(test.blocking, 1U);
  EXPECT_DOUBLE_EQ(test.step, 0.5);
}

TEST(RatioTest, GoesToItsLimitWhereNoBoundIsInTheWay) {
  const RatioTest test = ratio_test({{0.0, 1.0, -1.0, 3.0}, {5.0, 7.0, -no_bound, no_bound}}, 1.0, tolerance);
  EXPECT_FALSE(test.blocking);
  EXPECT_EQ(test.step, 1.0);
}

TEST(RatioTest, AnInfeasibleColumnIsStoppedByTheBoundItViolates) {
  // -4 must reach -1, not 3; 5 that moves further away is not stopped at all.
  const RatioTest test = ratio_test({{-4.0, 1.0, -1.0, 3.0}, {5.0, 1.0, -1.0, 3.0}}, no_bound, tolerance);
  EXPECT_EQ(test.blocking, 0U);
  EXPECT_DOUBLE_EQ(test.step, 3.0);
}

TEST(RatioTest, AColumnAtItsBoundAllowsNoStep) {
  const RatioTest test = ratio_test({{3.0, 1.0, -1.0, 3.0}}, 1.0, tolerance);
  EXPECT_EQ(test.blocking, 0U);
  EXPECT_EQ(test.step, 0.0);
}

TEST(RatioTest, OfTiesTakesTheLargestRate) {
  const RatioTest test = ratio_test({{0.0, 1e-4, 0.0, 1e-4}, {0.0, 2.0, 0.0, 2.0}}, no_bound, tolerance);
  EXPECT_EQ(test.blocking, 1U);
}

TEST(RatioTest, NeverLetsAColumnPassItsBoundByMoreThanTheTolerance) {
  const std::vector<MovingColumn> columns{
      {0.0, 1e-3, -1.0, 1e-3}, {0.0, 1.0, -1.0, 1.0 + 1e-8}, {0.0, 1e-6, -1.0, 2e-6}};
  const RatioTest test = ratio_test(columns, no_bound, tolerance);
  for (const MovingColumn& column : columns)
    EXPECT_LE(column.value + test.step * column.rate, column.upper + tolerance);
}

}  // namespace
}  // namespace dmocbench::sqp
