#include <gtest/gtest.h>

#include "methods/judgement/kkt_residual.hpp"
#include "tests/support/small_programs.hpp"

namespace dmocbench {
namespace {

using tests::everywhere;
using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

/// x₁² + x₂² = value with x₁ >= lower.
SmallProgram bounded_circle(double value, double lower) {
  return SmallProgram({[](const HyperVector& x) { return x[0]; },
                       [](const HyperVector& x) { return HyperVector{x[0] * x[0] + x[1] * x[1]}; },
                       vector({lower, -unbounded}), everywhere(2, unbounded), vector({value}), vector({value})});
}

/// x = 0 and x = 2 at once.
SmallProgram contradiction() {
  return tests::equality_program([](const HyperVector& x) { return x[0]; },
                                 [](const HyperVector& x) {
                                   return HyperVector{x[0], x[0]};
                                 },
                                 1, vector({0.0, 2.0}));
}

TEST(PointOfLeastViolation, IsWhereContradictingRowsBalance) {
  SmallProgram program = contradiction();
  EXPECT_TRUE(is_point_of_least_violation(program, vector({1.0})));
  EXPECT_FALSE(is_point_of_least_violation(program, vector({1.5})));
}

TEST(PointOfLeastViolation, IsWhereABoundHoldsWhatWouldHelp) {
  SmallProgram program = bounded_circle(1.0, 2.0);
  EXPECT_TRUE(is_point_of_least_violation(program, vector({2.0, 0.0})));
  EXPECT_FALSE(is_point_of_least_violation(program, vector({2.5, 0.0})));
}

TEST(PointOfLeastViolation, IsNotWhereTheRowsAreMet) {
  SmallProgram program = bounded_circle(1.0, 0.0);
  EXPECT_FALSE(is_point_of_least_violation(program, vector({1.0, 0.0})));
}

}  // namespace
}  // namespace dmocbench
