#include "methods/diagnostics/convergence_order.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>

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

/// 1/N for the default grids of a quick run.
const std::vector<double> quick_steps{1.0 / 16, 1.0 / 24, 1.0 / 32, 1.0 / 48, 1.0 / 64, 1.0 / 96, 1.0 / 128};

std::vector<GridError> errors_on(const std::vector<double>& steps, const std::function<double(double)>& error) {
  std::vector<GridError> points;
  for (const double step : steps) points.push_back({step, error(step)});
  return points;
}

std::optional<FittedOrder> fitted_in_range(const std::vector<GridError>& points, double least = 0.0) {
  const auto range = asymptotic_range(points, least);
  if (!range) return std::nullopt;
  const auto at = [&](std::size_t i) { return points.begin() + static_cast<std::ptrdiff_t>(i); };
  return fit_order({at(range->first), at(range->end)});
}

TEST(FitOrder, AgainstAFinerGridIsThatOfTheDifference) {
  constexpr double reference = 1.0 / 256;
  for (const double order : {1.0, 2.0, 3.0, 4.0, 8.0}) {
    const auto points =
        errors_on(quick_steps, [&](double h) { return std::pow(h, order) - std::pow(reference, order); });
    EXPECT_NEAR(tests::value_of(fit_order(points, reference)).order, order, 1e-9);
    for (const double local : neighbouring_orders(points, reference)) EXPECT_NEAR(local, order, 1e-8);
  }
  EXPECT_GT(fit_order(errors_on({1.0 / 64, 1.0 / 128}, [&](double h) { return h * h - reference * reference; }))->order,
            2.2);
}

TEST(AsymptoticRange, OfAPowerIsEveryGridWhateverTheOrder) {
  for (const double order : {1.0, 2.0, 3.0, 8.0}) {
    const auto range = tests::value_of(asymptotic_range(powers(order, 5.0, quick_steps), 0.0));
    EXPECT_EQ(range.first, 0U);
    EXPECT_EQ(range.end, quick_steps.size());
    EXPECT_EQ(range.coarse_end, RangeEnd::grids);
    EXPECT_EQ(range.fine_end, RangeEnd::grids);
  }
}

TEST(AsymptoticRange, GivesAnOrderNearTheOneOfTheLeadingTerm) {
  for (const double order : {2.0, 4.0, 6.0}) {
    for (const double a : {-4.0, -2.0, 2.0, 4.0, 8.0}) {
      const auto error = [&](double h) { return std::abs(std::pow(h, order) * (1.0 + a * h)); };
      const auto fitted = fitted_in_range(errors_on(quick_steps, error));
      ASSERT_TRUE(fitted.has_value()) << a;
      EXPECT_NEAR(fitted->order, order, largest_spread) << "order " << order << ", a = " << a;
    }
  }
}

TEST(AsymptoticRange, LeavesOutCoarseGridsOnWhichErrorsFallFaster) {
  const auto error = [](double h) { return h * h * (1.0 + std::pow(15.0 * h, 4.0)); };
  const auto points = errors_on(quick_steps, error);
  const auto range = tests::value_of(asymptotic_range(points, 0.0));
  EXPECT_GT(range.first, 0U);
  EXPECT_EQ(range.coarse_end, RangeEnd::orders);
  EXPECT_EQ(range.end, quick_steps.size());
}

TEST(AsymptoticRange, IsTheFinestEvenWhereMoreCoarseGridsAgreeOnAnotherOrder) {
  std::vector<double> steps{1.0 / 4, 1.0 / 6, 1.0 / 8, 1.0 / 12};
  steps.insert(steps.end(), quick_steps.begin(), quick_steps.end());
  for (const double more : {192.0, 256.0, 384.0, 512.0}) steps.push_back(1.0 / more);
  const auto fitted =
      fitted_in_range(errors_on(steps, [](double h) { return h * h * (1.0 + std::pow(60.0 * h, 4.0)); }));
  ASSERT_TRUE(fitted.has_value());
  EXPECT_NEAR(fitted->order, 2.0, 0.1);
}

TEST(AsymptoticRange, EndsAtTheFloor) {
  const auto points = errors_on(quick_steps, [](double h) { return 1e4 * std::pow(h, 8.0) + 1e-13; });
  const auto range = tests::value_of(asymptotic_range(points, 1e-11));
  EXPECT_EQ(range.fine_end, RangeEnd::floor);
  EXPECT_NEAR(fitted_in_range(points, 1e-11)->order, 8.0, 0.1);
  // What lies behind the first grid at the floor is noise, even where it seems to fall again.
  auto risen = points;
  risen.back().error = 1e-5;
  EXPECT_EQ(tests::value_of(asymptotic_range(risen, 1e-11)).end, range.end);
}

TEST(AsymptoticRange, NeedsFourGrids) {
  EXPECT_FALSE(asymptotic_range(powers(2.0, 1.0, {0.1, 0.05, 0.025}), 0.0).has_value());
  EXPECT_FALSE(asymptotic_range(powers(2.0, 1.0, {0.1, 0.05, 0.025, 0.0125}), 0.0002).has_value());
  EXPECT_TRUE(asymptotic_range(powers(2.0, 1.0, {0.1, 0.05, 0.025, 0.0125}), 0.0).has_value());
  EXPECT_FALSE(asymptotic_range(powers(0.0, 0.0, quick_steps), 0.0).has_value()) << "no error at all";
}

/// The fitted orders of errors h^2 exp(noise g) with normally distributed g, by 200 seeds.
std::vector<double> orders_under_noise(double noise) {
  std::vector<double> orders;
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    const auto points = errors_on(quick_steps, [&](double h) { return h * h * std::exp(noise * normal(engine)); });
    if (const auto fitted = fitted_in_range(points)) orders.push_back(fitted->order);
  }
  return orders;
}

TEST(AsymptoticRange, IsFoundUnderSmallNoiseAndSeldomUnderLargeNoise) {
  const std::vector<double> quiet = orders_under_noise(0.01);
  EXPECT_GT(quiet.size(), 190U);
  for (const double order : quiet) EXPECT_NEAR(order, 2.0, largest_spread);
  EXPECT_LT(orders_under_noise(0.5).size(), 10U);
}

}  // namespace
}  // namespace dmocbench
