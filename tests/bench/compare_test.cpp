#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/compare/comparison.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

using tests::expect_error_naming;

const std::vector<double> some_times{10.0, 10.2, 9.9, 10.1, 10.3};

std::vector<double> multiplied(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

SpeedComparison comparison_of(const std::vector<double>& before, const std::vector<double>& after,
                              const ComparisonOptions& options = {}) {
  return compare({{"f", before}}, {{"f", after}}, options).at(0);
}

TEST(Compare, CallsShiftedSamplesSlower) {
  const SpeedComparison what = comparison_of(some_times, multiplied(some_times, 1.2));
  EXPECT_EQ(what.verdict, SpeedVerdict::slower);
  EXPECT_NEAR(what.ratio, 1.2, 1e-12);
  EXPECT_EQ(what.repetitions_before, 5U);
}

TEST(Compare, CallsTheReverseFaster) {
  EXPECT_EQ(comparison_of(multiplied(some_times, 1.2), some_times).verdict, SpeedVerdict::faster);
}

TEST(Compare, TakesMoreOfARateForFaster) {
  const ComparisonOptions rate{.counter = "items_per_second"};
  EXPECT_EQ(comparison_of(some_times, multiplied(some_times, 1.2), rate).verdict, SpeedVerdict::faster);
  EXPECT_EQ(comparison_of(multiplied(some_times, 1.2), some_times, rate).verdict, SpeedVerdict::slower);
}

TEST(Compare, LeavesDifferencesBelowTheThreshold) {
  const std::vector<double> slowed = multiplied(some_times, 1.1);
  EXPECT_EQ(comparison_of(some_times, slowed, {.threshold = 1.2}).verdict, SpeedVerdict::same);
  EXPECT_EQ(comparison_of(slowed, some_times, {.threshold = 1.2}).verdict, SpeedVerdict::same);
  EXPECT_EQ(comparison_of(some_times, slowed, {.threshold = 1.05}).verdict, SpeedVerdict::slower);
}

TEST(Compare, LeavesMediansApartWithinNoise) {
  // The medians are 10 and 12, but the samples overlap.
  EXPECT_EQ(comparison_of({8.0, 9.0, 10.0, 14.0, 15.0}, {8.5, 9.5, 12.0, 14.5, 15.5}).verdict, SpeedVerdict::same);
}

TEST(Compare, IsNotMisledByOneDisturbedRepetition) {
  const std::vector<double> disturbed{10.0, 10.2, 9.9, 10.1, 100.0};
  EXPECT_EQ(comparison_of(some_times, disturbed).verdict, SpeedVerdict::same);
}

TEST(Compare, NeedsFiveRepetitionsOfBoth) {
  const std::vector<double> four(some_times.begin(), some_times.end() - 1);
  EXPECT_EQ(comparison_of(four, multiplied(some_times, 2.0)).verdict, SpeedVerdict::too_few_repetitions);
  EXPECT_EQ(comparison_of(some_times, multiplied(four, 2.0)).verdict, SpeedVerdict::too_few_repetitions);
  EXPECT_EQ(comparison_of(some_times, multiplied(some_times, 2.0)).verdict, SpeedVerdict::slower);
}

TEST(Compare, LooksAtCommonBenchmarksOnly) {
  const auto comparisons =
      compare({{"a", some_times}, {"b", some_times}}, {{"b", some_times}, {"c", some_times}}, ComparisonOptions{});
  ASSERT_EQ(comparisons.size(), 1U);
  EXPECT_EQ(comparisons[0].name, "b");
}

TEST(Compare, RefusesFilesWithNothingInCommon) {
  expect_error_naming({"in common", "a", "b"}, [] {
    (void)compare({{"a", some_times}}, {{"b", some_times}}, ComparisonOptions{});
  });
}

TEST(Compare, RefusesOptionsOutOfRange) {
  for (const double wrong : {0.9, -1.0, std::nan("")}) {
    expect_error_naming({"threshold"}, [&] { (void)comparison_of(some_times, some_times, {.threshold = wrong}); });
  }
  for (const double wrong : {1.1, -0.1, std::nan("")}) {
    expect_error_naming({"significance"},
                        [&] { (void)comparison_of(some_times, some_times, {.significance = wrong}); });
  }
}

TEST(Compare, TellsTheSameInTextAndTable) {
  const auto comparisons = compare({{"f", some_times}}, {{"f", multiplied(some_times, 1.2)}}, ComparisonOptions{});
  const Table table = Table::from_csv(comparison_table(comparisons).csv());
  ASSERT_EQ(table.rows().size(), 1U);
  EXPECT_EQ(table.rows()[0].text("verdict"), "slower");
  EXPECT_EQ(table.rows()[0].number("ratio"), comparisons[0].ratio);
  EXPECT_NE(comparison_text(comparisons).find("1 slower"), std::string::npos);
}

/// JSON files as Google Benchmark writes them.
class CompareFiles : public tests::InTemporaryFolder {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& content, const std::string& name = "run.json") const {
    std::filesystem::path path = folder() / name;
    std::ofstream(path) << content;
    return path;
  }
  /// Of the entries of "benchmarks", separated by commas.
  [[nodiscard]] std::filesystem::path run(const std::string& entries, const std::string& name = "run.json") const {
    return file(R"({"context": {"num_cpus": 2}, "benchmarks": [)" + entries + "]}", name);
  }
  static std::string repetition(double time, const std::string& unit = "ns", const std::string& more = "") {
    return fmt::format(
        R"({{"name": "f/repeats:2", "run_name": "f", "run_type": "iteration", "repetitions": 2, "iterations": 7,
             "real_time": {}, "cpu_time": {}, "time_unit": "{}", "items_per_second": 3.5{}}})",
        2.0 * time, time, unit, more);
  }
};

TEST_F(CompareFiles, GiveEveryRepetition) {
  const auto path = run(repetition(1.5) + "," + repetition(2.5));
  EXPECT_EQ(read_samples({path}, "cpu_time"), (BenchmarkSamples{{"f", {1.5, 2.5}}}));
  EXPECT_EQ(read_samples({path}, "real_time"), (BenchmarkSamples{{"f", {3.0, 5.0}}}));
  EXPECT_EQ(read_samples({path}, "items_per_second"), (BenchmarkSamples{{"f", {3.5, 3.5}}}));
}

TEST_F(CompareFiles, GiveTimesInOneUnit) {
  EXPECT_EQ(read_samples({run(repetition(1.5, "ms") + "," + repetition(2.5, "us"))}, "cpu_time"),
            (BenchmarkSamples{{"f", {1.5e6, 2.5e3}}}));
}

TEST_F(CompareFiles, GiveNoAggregatesAndNoFailures) {
  const std::string aggregate =
      R"({"name": "f_median", "run_name": "f", "run_type": "aggregate", "cpu_time": 9, "time_unit": "ns"})";
  const std::string failure = repetition(9.0, "ns", R"(, "error_occurred": true)");
  EXPECT_EQ(read_samples({run(repetition(1.5) + "," + aggregate + "," + failure)}, "cpu_time"),
            (BenchmarkSamples{{"f", {1.5}}}));
}

TEST_F(CompareFiles, TellWhatWasMeasuredInLabels) {
  const Benchmarks benchmarks = parse_benchmarks(
      "{\"benchmarks\": [" + repetition(1.5, "us", R"(, "label": "way=tape warm N=64")") + "]}", "run");
  const Benchmark& benchmark = benchmarks.at("f");
  EXPECT_EQ(benchmark.label("way"), "tape");
  EXPECT_EQ(benchmark.label("N"), "64");
  EXPECT_EQ(benchmark.label("warm"), "");
  EXPECT_EQ(benchmark.median_of("cpu_time"), 1500.0);
  EXPECT_FALSE(benchmark.smallest_of("colour").has_value());
}

TEST_F(CompareFiles, CountAsOneRepetitionEachWhereThereAreSeveral) {
  const auto first = run(repetition(1.0) + "," + repetition(9.0) + "," + repetition(2.0), "first.json");
  const auto second = run(repetition(5.0) + "," + repetition(4.0), "second.json");
  const std::vector both{first, second};
  EXPECT_EQ(read_samples(both, "cpu_time"), (BenchmarkSamples{{"f", {2.0, 4.5}}}));
  EXPECT_EQ(read_samples({first}, "cpu_time"), (BenchmarkSamples{{"f", {1.0, 9.0, 2.0}}}));
}

TEST_F(CompareFiles, ShowNoDifferenceToThemselves) {
  std::string entries;
  for (const double time : some_times) entries += (entries.empty() ? "" : ",") + repetition(time);
  const BenchmarkSamples samples = read_samples({run(entries)}, "cpu_time");
  const auto comparisons = compare(samples, samples, {.threshold = 1.0, .significance = 0.99});
  ASSERT_EQ(comparisons.size(), 1U);
  EXPECT_EQ(comparisons[0].verdict, SpeedVerdict::same);
  EXPECT_EQ(comparisons[0].ratio, 1.0);
  EXPECT_EQ(comparisons[0].probability, 1.0);
}

TEST_F(CompareFiles, AreRefusedByNameWhereTheyAreNone) {
  for (const char* content :
       {"", "benchmarks", "{", "{}", "[]", "3", R"({"benchmarks": 3})", R"({"benchmarks": [3]})",
        R"({"benchmarks": [{"name": "f", "cpu_time": "fast"}]})", R"({"benchmarks": [{"cpu_time": 3}]})"}) {
    const auto path = file(content);
    expect_error_naming({path.string()}, [&] { (void)read_samples({path}, "cpu_time"); });
  }
}

TEST_F(CompareFiles, AreRefusedWhereThereIsNone) {
  expect_error_naming({"none.json"}, [] { (void)read_samples({"none.json"}, "cpu_time"); });
  expect_error_naming({"no file"}, [] { (void)read_samples({}, "cpu_time"); });
}

TEST_F(CompareFiles, AreRefusedWithoutRepetitions) {
  const auto path = run(R"({"name": "f_median", "run_name": "f", "run_type": "aggregate", "cpu_time": 9})");
  expect_error_naming({path.string(), "repetition"}, [&] { (void)read_samples({path}, "cpu_time"); });
}

TEST_F(CompareFiles, NameTheCountersThatThereAre) {
  const auto path = run(repetition(1.5));
  expect_error_naming({"colour", "cpu_time", "items_per_second", "real_time"},
                      [&] { (void)read_samples({path}, "colour"); });
}

TEST_F(CompareFiles, MayHoldTheNumbersThatJsonDoesNotKnow) {
  const std::string odd = R"(, "label": "-NaN \" NaN", "colour": NaN, "size": -Infinity)";
  EXPECT_EQ(read_samples({run(repetition(1.5, "ns", odd))}, "cpu_time"), (BenchmarkSamples{{"f", {1.5}}}));
  const auto path = run(repetition(1.5, "ns", odd));
  expect_error_naming({"colour", "nan", "ratio"}, [&] { (void)read_samples({path}, "colour"); });
}

TEST_F(CompareFiles, AreRefusedWhereThereIsNoRatio) {
  const auto path = run(repetition(0.0));
  expect_error_naming({"cpu_time", "ratio"}, [&] { (void)read_samples({path}, "cpu_time"); });
}

}  // namespace
}  // namespace dmocbench
