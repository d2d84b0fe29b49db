// JSON as Google Benchmark writes it.
#include "bench/speed/benchmark_file.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

std::string repetition(double time, const std::string& unit = "ns", const std::string& more = "") {
  return fmt::format(
      R"({{"name": "f/repeats:2", "run_name": "f", "run_type": "iteration", "repetitions": 2, "iterations": 7,
           "real_time": {}, "cpu_time": {}, "time_unit": "{}", "items_per_second": 3.5{}}})",
      2.0 * time, time, unit, more);
}

/// Of the entries of "benchmarks", separated by commas.
Benchmarks run(const std::string& entries) {
  return parse_benchmarks(R"({"context": {"num_cpus": 2}, "benchmarks": [)" + entries + "]}", "run.json");
}

using Values = std::vector<double>;

TEST(BenchmarkFile, GivesEveryRepetitionInOneUnitOfTime) {
  const auto numbers = run(repetition(1.5, "ms") + "," + repetition(2.5, "us")).at("f").numbers;
  EXPECT_EQ(numbers.at("cpu_time"), (Values{1.5e6, 2.5e3}));
  EXPECT_EQ(numbers.at("real_time"), (Values{3e6, 5e3}));
  EXPECT_EQ(numbers.at("items_per_second"), (Values{3.5, 3.5}));
}

TEST(BenchmarkFile, GivesNoAggregatesAndNoFailures) {
  const std::string aggregate =
      R"({"name": "f_median", "run_name": "f", "run_type": "aggregate", "cpu_time": 9, "time_unit": "ns"})";
  const std::string failure = repetition(9.0, "ns", R"(, "error_occurred": true)");
  EXPECT_EQ(run(repetition(1.5) + "," + aggregate + "," + failure).at("f").numbers.at("cpu_time"), Values{1.5});
}

TEST(BenchmarkFile, TellsWhatWasMeasuredInLabels) {
  const Benchmark benchmark = run(repetition(1.5, "us", R"(, "label": "way=tape warm N=64")")).at("f");
  EXPECT_EQ(benchmark.label("way"), "tape");
  EXPECT_EQ(benchmark.label("N"), "64");
  EXPECT_EQ(benchmark.label("warm"), "");
  EXPECT_EQ(benchmark.median_of("cpu_time"), 1500.0);
  EXPECT_FALSE(benchmark.smallest_of("colour").has_value());
}

TEST(BenchmarkFile, IsRefusedByNameWhereItIsNone) {
  for (const char* content : {"", "benchmarks", "{", "{}", "[]", "3", R"({"benchmarks": 3})", R"({"benchmarks": [3]})",
                              R"({"benchmarks": [{"cpu_time": 3}]})"}) {
    tests::expect_error_naming({"run.json"}, [&] { (void)parse_benchmarks(content, "run.json"); });
  }
}

TEST(BenchmarkFile, MayHoldTheNumbersThatJsonDoesNotKnow) {
  const std::string odd = R"(, "label": "-NaN \" NaN", "colour": NaN, "size": -Infinity)";
  const Benchmark benchmark = run(repetition(1.5, "ns", odd)).at("f");
  EXPECT_EQ(benchmark.numbers.at("cpu_time"), Values{1.5});
  EXPECT_TRUE(std::isnan(benchmark.numbers.at("colour").front()));
}

}  // namespace
}  // namespace dmocbench
