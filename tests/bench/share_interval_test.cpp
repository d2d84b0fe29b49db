#include <cmath>

#include <gtest/gtest.h>

#include "bench/tables/ratio_interval.hpp"

namespace dmocbench {
namespace {

TEST(WilsonInterval, SolvesItsQuadraticEquation) {
  // The ends are the shares π with |hits/n - π| = z sqrt(π(1 - π)/n).
  constexpr double z = 1.959963984540054;
  for (const ShareCount& count : {ShareCount{10, 40}, {1, 7}, {199, 200}}) {
    const auto n = static_cast<double>(count.trials);
    const ShareInterval interval = wilson_interval(count);
    for (const double end : {interval.lower, interval.upper}) {
      EXPECT_NEAR(std::abs(count.share() - end), z * std::sqrt(end * (1.0 - end) / n), 1e-12);
    }
  }
  EXPECT_EQ(wilson_interval({0, 20}).lower, 0.0);
  EXPECT_GT(wilson_interval({0, 20}).upper, 0.0);
  EXPECT_EQ(wilson_interval({20, 20}).upper, 1.0);
}

TEST(WilsonInterval, IsTheOneThatNewcombePrints) {
  // "Two-sided confidence intervals for the single proportion", 1998, table I, method 3.
  struct Printed {
    ShareCount count;
    double lower = 0.0;
    double upper = 0.0;
  };
  for (const Printed& printed : {Printed{{81, 263}, 0.2553, 0.3662},
                                 {{15, 148}, 0.0624, 0.1605},
                                 {{0, 20}, 0.0, 0.1611},
                                 {{1, 29}, 0.0061, 0.1718}}) {
    EXPECT_NEAR(wilson_interval(printed.count).lower, printed.lower, 5e-5);
    EXPECT_NEAR(wilson_interval(printed.count).upper, printed.upper, 5e-5);
  }
}

TEST(DifferenceInterval, IsTheOneThatNewcombePrints) {
  // "Interval estimation for the difference between independent proportions", 1998, table II, method 10.
  const ShareInterval first = difference_interval({56, 70}, {48, 80});
  EXPECT_NEAR(first.lower, 0.0524, 5e-5);
  EXPECT_NEAR(first.upper, 0.3339, 5e-5);
  const ShareInterval second = difference_interval({9, 10}, {3, 10});
  EXPECT_NEAR(second.lower, 0.1705, 5e-5);
  EXPECT_NEAR(second.upper, 0.8090, 5e-5);
}

TEST(DifferenceInterval, ChangesItsSignWithTheOrderAndHoldsZeroForEqualCounts) {
  const ShareInterval forward = difference_interval({30, 40}, {11, 50});
  const ShareInterval backward = difference_interval({11, 50}, {30, 40});
  EXPECT_NEAR(forward.lower, -backward.upper, 1e-15);
  EXPECT_NEAR(forward.upper, -backward.lower, 1e-15);
  for (const ShareCount& count : {ShareCount{0, 9}, {5, 9}, {9, 9}}) {
    const ShareInterval equal = difference_interval(count, count);
    EXPECT_LT(equal.lower, 0.0);
    EXPECT_GT(equal.upper, 0.0);
  }
}

}  // namespace
}  // namespace dmocbench
