#include <limits>

#include <gtest/gtest.h>

#include "methods/solvers/interior_point/filter_line_search.hpp"

namespace dmocbench::interior_point {
namespace {

Filter filter_with_largest_violation(double largest) {
  Filter filter;
  filter.reset(largest);
  return filter;
}

TEST(Filter, AcceptsEverythingUpToTheLargestViolationWhileEmpty) {
  const Filter filter = filter_with_largest_violation(10.0);
  EXPECT_TRUE(filter.accepts(10.0, 1e300));
  EXPECT_FALSE(filter.accepts(10.1, -1e300));
}

TEST(Filter, RefusesAViolationThatIsNotANumber) {
  EXPECT_FALSE(filter_with_largest_violation(10.0).accepts(std::numeric_limits<double>::quiet_NaN(), 0.0));
}

TEST(Filter, AsksForLessOfOneOfBothAndNotOfBoth) {
  Filter filter = filter_with_largest_violation(10.0);
  filter.add(2.0, 5.0);
  EXPECT_FALSE(filter.accepts(2.0, 5.0));
  EXPECT_FALSE(filter.accepts(3.0, 6.0));
  EXPECT_TRUE(filter.accepts(1.0, 100.0));
  EXPECT_TRUE(filter.accepts(9.0, 4.0));
}

TEST(Filter, AsksForMoreThanItsMargin) {
  Filter filter = filter_with_largest_violation(10.0);
  filter.add(2.0, 5.0);
  const double half = 0.5 * Filter::margin;
  const double twice = 2.0 * Filter::margin;
  EXPECT_FALSE(filter.accepts(2.0 * (1.0 - half), 5.0));
  EXPECT_TRUE(filter.accepts(2.0 * (1.0 - twice), 5.0));
  EXPECT_FALSE(filter.accepts(2.0, 5.0 - half * 2.0));
  EXPECT_TRUE(filter.accepts(2.0, 5.0 - twice * 2.0));
}

TEST(Filter, AsksTheSameOfEveryPair) {
  Filter filter = filter_with_largest_violation(10.0);
  filter.add(2.0, 5.0);
  filter.add(1.0, 7.0);
  EXPECT_FALSE(filter.accepts(1.5, 8.0)) << "better than the first, worse than the second";
  EXPECT_FALSE(filter.accepts(3.0, 6.0)) << "better than the second, worse than the first";
  EXPECT_TRUE(filter.accepts(1.5, 6.0)) << "between both";
}

TEST(Filter, ForgetsItsPairsWhenReset) {
  Filter filter = filter_with_largest_violation(10.0);
  filter.add(2.0, 5.0);
  filter.reset(3.0);
  EXPECT_TRUE(filter.accepts(2.0, 5.0));
  EXPECT_FALSE(filter.accepts(4.0, 0.0));
}

}  // namespace
}  // namespace dmocbench::interior_point
