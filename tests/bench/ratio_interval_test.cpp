// Ratios of times that were measured in rounds: the interval of their median.
#include "bench/tables/ratio_interval.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {
namespace {

TEST(RatioInterval, OfEqualRoundsIsAPoint) {
  const RatioInterval interval = ratio_interval(std::vector<double>(10, 1.25));
  EXPECT_EQ(interval.ratio, 1.25);
  EXPECT_EQ(interval.lower, 1.25);
  EXPECT_EQ(interval.upper, 1.25);
  EXPECT_EQ(interval.rounds, 10U);
}

TEST(RatioInterval, IsHardlyMovedByOneInterruption) {
  const std::vector<double> calm{1.29, 1.3, 1.31, 1.3, 1.32, 1.28, 1.3, 1.31, 1.29, 1.3, 1.3};
  std::vector<double> interrupted = calm;
  interrupted[4] = 40.0;
  EXPECT_NEAR(ratio_interval(interrupted).ratio, ratio_interval(calm).ratio, 0.011);
  EXPECT_LT(ratio_interval(interrupted).upper, 1.33);
}

/// The median of a sample of eleven lies outside of its own 99 % interval's counterpart rarely: the bootstrap of a
/// median is coarse at eleven values, so that this asks for 95 %.
TEST(RatioInterval, HoldsTheTrueRatioInNearlyAllSamples) {
  std::mt19937 engine(3);  // NOLINT(cert-msc51-cpp): the same samples each time
  const auto uniform = [&] { return static_cast<double>(engine()) / 4294967296.0; };
  int held = 0;
  constexpr int samples = 200;
  for (int i = 0; i < samples; ++i) {
    std::vector<double> ratios(11);
    for (double& ratio : ratios) ratio = 1.5 * std::exp(0.2 * (uniform() + uniform() - 1.0));
    const RatioInterval interval = ratio_interval(ratios);
    held += interval.lower <= 1.5 && interval.upper >= 1.5 ? 1 : 0;
  }
  EXPECT_GE(held, samples * 95 / 100);
}

TEST(RatioInterval, DrawsTheSameRoundsForRatiosOfTheSameRounds) {
  std::vector<double> ratios{1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2.0};
  const RatioInterval one = ratio_interval(ratios);
  for (double& ratio : ratios) ratio *= 2.0;
  const RatioInterval twice = ratio_interval(ratios);
  for (std::size_t b = 0; b < resamples; ++b) EXPECT_DOUBLE_EQ(twice.resampled[b], 2.0 * one.resampled[b]);
}

TEST(RatioInterval, RefusesWhatIsNoRatio) {
  EXPECT_THROW(static_cast<void>(ratio_interval(std::vector<double>{})), Error);
  EXPECT_THROW(static_cast<void>(ratio_interval(std::vector<double>{1.0, 0.0})), Error);
  EXPECT_THROW(static_cast<void>(ratio_interval(std::vector<double>{1.0, std::nan("")})), Error);
}

TEST(RatioInterval, PairsTheRoundsThatBothHave) {
  EXPECT_EQ(round_ratios(std::vector<double>{2.0, 6.0, 1.0}, std::vector<double>{1.0, 2.0}),
            (std::vector<double>{2.0, 3.0}));
}

TEST(NumbersOfAField, AreReadAsTheyWereWritten) {
  Row row;
  row.set("rounds", joined_numbers(std::vector<double>{0.25, 1e-5, 3.0}));
  EXPECT_EQ(row.numbers("rounds"), (std::vector<double>{0.25, 1e-5, 3.0}));
  EXPECT_TRUE(row.numbers("nothing").empty());
  for (const char* wrong : {"1 two", "nan", "1  2", "1,2", " 1", "1e999"}) {
    row.set("rounds", wrong);
    EXPECT_THROW(static_cast<void>(row.numbers("rounds")), Error) << wrong;
  }
}

}  // namespace
}  // namespace dmocbench
