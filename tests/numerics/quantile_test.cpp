#include "methods/numerics/quantile.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace dmocbench {
namespace {

TEST(Median, HasAsManyNumbersBelowAsAbove) {
  EXPECT_EQ(median({3.0}), 3.0);
  EXPECT_EQ(median({5.0, -1.0, 2.0}), 2.0);
  EXPECT_EQ(median({9.0, 1.0, 7.0, 1.0, 8.0}), 7.0);
}

TEST(Median, OfAnEvenCountIsTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ(median({4.0, 1.0}), 2.5);
  EXPECT_EQ(median({10.0, 2.0, 4.0, -7.0}), 3.0);
}

TEST(Median, OfNoneIsNotANumber) { EXPECT_TRUE(std::isnan(median({}))); }

}  // namespace
}  // namespace dmocbench
