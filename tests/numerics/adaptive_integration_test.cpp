#include "methods/numerics/adaptive_integration.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {
namespace {

/// x = (cos t², -sin t²) from x(0) = (1, 0), forwards and back.
template <class Scalar>
void expect_that_a_turn_of_growing_speed_is_followed(Scalar tolerance) {
  const auto turn = [](const std::vector<Scalar>& x, std::vector<Scalar>& rate, Scalar t) {
    rate[0] = 2 * t * x[1];
    rate[1] = -2 * t * x[0];
  };
  std::vector<Scalar> x{1, 0};
  ASSERT_TRUE(integrate(turn, x, 0, 3, 1, tolerance));
  EXPECT_LT(std::hypot(x[0] - std::cos(Scalar(9)), x[1] + std::sin(Scalar(9))), 1000 * tolerance);
  ASSERT_TRUE(integrate(turn, x, 3, 0, -1, tolerance));
  EXPECT_LT(std::hypot(x[0] - 1, x[1]), 1000 * tolerance);
}

TEST(AdaptiveIntegration, FollowsATurnOfGrowingSpeed) {
  expect_that_a_turn_of_growing_speed_is_followed<double>(1e-12);
  expect_that_a_turn_of_growing_speed_is_followed<double>(1e-6);
  expect_that_a_turn_of_growing_speed_is_followed<long double>(1e-17L);
}

TEST(AdaptiveIntegration, GivesUpAfterTheMostEvaluations) {
  long evaluations = 0;
  const auto turn = [&](const std::vector<double>& x, std::vector<double>& rate, double) {
    ++evaluations;
    rate[0] = x[1];
    rate[1] = -x[0];
  };
  std::vector<double> x{1.0, 0.0};
  EXPECT_FALSE(integrate(turn, x, 0.0, 1e5, 1.0, 1e-12));
  EXPECT_EQ(evaluations, most_evaluations);
}

TEST(AdaptiveIntegration, EndsWithItsStopScope) {
  const auto spin = [](const std::vector<double>& x, std::vector<double>& rate, double) {
    rate[0] = 1e9 * x[1];
    rate[1] = -1e9 * x[0];
  };
  std::vector<double> x{1.0, 0.0};
  const StopScope scope(nullptr, 1e-5);
  EXPECT_THROW(static_cast<void>(integrate(spin, x, 0.0, 1.0, 1.0, 1e-12)), Stopped);
}

}  // namespace
}  // namespace dmocbench
