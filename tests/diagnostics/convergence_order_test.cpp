#include "methods/diagnostics/convergence_order.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

std::vector<GridError> powers(double order, double factor, const std::vector<double>& steps) {
  std::vector<GridError> points;
  points.reserve(steps.size());
  for (const double step : steps) points.push_back({step, factor * std::pow(step, order)});
  return points;
}

TEST(FitOrder, IsExactOnAPower) {
  for (const double order : {1.0, 2.0, 3.5, -2.0}) {
    const auto fitted = tests::value_of(fit_order(powers(order, 7.0, {0.1, 0.05, 0.025, 0.02})));
    EXPECT_NEAR(fitted.order, order, 1e-13);
    EXPECT_NEAR(fitted.standard_error, 0.0, 1e-13);
    EXPECT_EQ(fitted.points, 4);
    EXPECT_EQ(fitted.first_abscissa, 0.02);
    EXPECT_EQ(fitted.last_abscissa, 0.1);
  }
}

TEST(FitOrder, GivesTheTextbookSlopeAndStandardError) {
  // Over log h = 0, 1, 2, 3 the logs of the errors 1, 3, 2, 6: slope 7/5, residuals -0.9, 0.7, -1.3... by hand:
  // x̄ = 1.5, ȳ = 3, Σxx = 5, Σxy = 7; residuals 0.1, 0.7, -1.7, 0.9 have squares 4.2; s² = 4.2/2/5.
  std::vector<GridError> points;
  const std::vector<double> logs{1.0, 3.0, 2.0, 6.0};
  for (std::size_t i = 0; i < logs.size(); ++i) {
    points.push_back({std::exp(static_cast<double>(i)), std::exp(logs[i])});
  }
  const auto fitted = tests::value_of(fit_order(points));
  EXPECT_NEAR(fitted.order, 1.4, 1e-13);
  EXPECT_NEAR(fitted.standard_error, std::sqrt(0.42), 1e-13);
}

TEST(FitOrder, LeavesOutPointsWithoutALogarithm) {
  std::vector<GridError> points = powers(2.0, 1.0, {0.1, 0.05, 0.025});
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const GridError& bad :
       {GridError{0.2, 0.0}, GridError{0.2, -1.0}, GridError{0.2, nan}, GridError{0.2, infinity}, GridError{0.0, 1.0},
        GridError{nan, 1.0}, GridError{-0.1, 1.0}, GridError{infinity, 1.0}}) {
    points.push_back(bad);
  }
  const auto fitted = tests::value_of(fit_order(points));
  EXPECT_NEAR(fitted.order, 2.0, 1e-13);
  EXPECT_EQ(fitted.points, 3);
  EXPECT_EQ(fitted.last_abscissa, 0.1);
}

TEST(FitOrder, HasNoStandardErrorWithTwoPointsAndNoSlopeWithFewer) {
  const auto fitted = tests::value_of(fit_order(powers(2.0, 3.0, {0.1, 0.2})));
  EXPECT_NEAR(fitted.order, 2.0, 1e-13);
  EXPECT_EQ(fitted.standard_error, 0.0);
  EXPECT_FALSE(fit_order({}).has_value());
  EXPECT_FALSE(fit_order({{0.1, 1.0}}).has_value());
  EXPECT_FALSE(fit_order({{0.1, 1.0}, {0.1, 2.0}}).has_value()) << "one step, no slope";
}

}  // namespace
}  // namespace dmocbench
