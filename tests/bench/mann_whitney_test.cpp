#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "bench/compare/comparison.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// U of the first sample: pairs that it wins, ties half.
double wins(const std::vector<double>& first, const std::vector<double>& second) {
  double sum = 0.0;
  for (const double a : first) {
    for (const double b : second) sum += a > b ? 1.0 : a == b ? 0.5 : 0.0;
  }
  return sum;
}

/// The test by its definition: every way to divide the values is tried.
double by_enumeration(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<double> values = first;
  values.insert(values.end(), second.begin(), second.end());
  const double balanced = 0.5 * static_cast<double>(first.size() * second.size());
  const double seen = std::abs(wins(first, second) - balanced);
  int far = 0;
  int all = 0;
  for (std::uint32_t chosen = 0; chosen < (1U << values.size()); ++chosen) {
    std::vector<double> in;
    std::vector<double> out;
    for (std::size_t i = 0; i < values.size(); ++i) ((chosen >> i & 1U) != 0 ? in : out).push_back(values[i]);
    if (in.size() != first.size()) continue;
    ++all;
    if (std::abs(wins(in, out) - balanced) >= seen - 1e-9) ++far;
  }
  return static_cast<double>(far) / all;
}

TEST(MannWhitney, IsExactForSmallSamplesWithAndWithoutTies) {
  std::mt19937_64 generator(1);
  for (std::size_t trial = 0; trial < 30; ++trial) {
    std::vector<double> first(1 + trial % 5);
    std::vector<double> second(1 + trial % 7);
    std::uniform_int_distribution<int> values(0, trial % 2 == 0 ? 4 : 1000);
    for (double& value : first) value = values(generator);
    for (double& value : second) value = values(generator);
    EXPECT_NEAR(mann_whitney(first, second), by_enumeration(first, second), 1e-12) << "trial " << trial;
    EXPECT_EQ(mann_whitney(first, second), mann_whitney(second, first));
  }
}

TEST(MannWhitney, KnowsThePublishedTableOfFiveAndFive) {
  // Whole separation: two of the 252 ways to divide ten values.
  EXPECT_NEAR(mann_whitney(std::vector{1.0, 2.0, 3.0, 4.0, 5.0}, std::vector{6.0, 7.0, 8.0, 9.0, 10.0}), 2.0 / 252.0,
              1e-15);
  // U = 2 is the critical value of the table at 5 %.
  EXPECT_LE(mann_whitney(std::vector{1.0, 2.0, 3.0, 4.0, 7.0}, std::vector{5.0, 6.0, 8.0, 9.0, 10.0}), 0.05);
  EXPECT_GT(mann_whitney(std::vector{1.0, 2.0, 3.0, 4.0, 8.0}, std::vector{5.0, 6.0, 7.0, 9.0, 10.0}), 0.05);
}

TEST(MannWhitney, FindsNothingInEqualValues) {
  EXPECT_EQ(mann_whitney(std::vector(5, 1.0), std::vector(7, 1.0)), 1.0);
  EXPECT_EQ(mann_whitney(std::vector(50, 1.0), std::vector(70, 1.0)), 1.0);
}

TEST(MannWhitney, GoesOverToTheNormalDistributionWithoutAJump) {
  std::mt19937_64 generator(2);
  std::normal_distribution<double> numbers;
  for (const double shift : {0.0, 0.5, 1.0}) {
    std::vector<double> first(20);
    std::vector<double> second(20);
    for (double& value : first) value = numbers(generator);
    for (double& value : second) value = numbers(generator) + shift;
    const double exact = mann_whitney(first, second);
    // One value more in the middle of both samples, so that ranks stay as balanced as they were.
    second.push_back(0.5 * shift);
    EXPECT_NEAR(mann_whitney(first, second), exact, 0.05) << "shift " << shift;
  }
}

TEST(MannWhitney, CallsChanceADifferenceNoMoreOftenThanItSays) {
  std::mt19937_64 generator(3);
  std::exponential_distribution<double> numbers;
  int differences = 0;
  constexpr int trials = 2000;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> first(8);
    std::vector<double> second(8);
    for (double& value : first) value = numbers(generator);
    for (double& value : second) value = numbers(generator);
    if (mann_whitney(first, second) <= 0.05) ++differences;
  }
  EXPECT_LT(differences, 0.06 * trials);
  EXPECT_GT(differences, 0.03 * trials);
}

TEST(MannWhitney, RefusesAnEmptySample) {
  tests::expect_error_naming({"both"}, [] { (void)mann_whitney({}, std::vector{1.0}); });
}

}  // namespace
}  // namespace dmocbench
