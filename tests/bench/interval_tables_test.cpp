#include <string>

#include <gtest/gtest.h>

#include "bench/speed/speed_tables.hpp"

namespace dmocbench::speed {
namespace {

/// A machine with two levels of memory, and an evaluation of 40 operations on 80 bytes per interval: 2 ns of
/// arithmetic; 0.8 ns of the first level, 8 ns of the second.
Benchmarks run_of(const std::string& intervals) {
  Benchmarks run;
  run["machine/arithmetic/avx2"] = {.labels = {{"instruction_set", "avx2"}, {"limit", "arithmetic"}},
                                    .numbers = {{operations_per_second, {20e9}}}};
  run["machine/triad_l1/avx2"] = {.labels = {{"instruction_set", "avx2"},
                                             {"limit", "l1"},
                                             {"array_bytes", "16000"},
                                             {"more_than_bytes", "0"},
                                             {"up_to_bytes", "32000"}},
                                  .numbers = {{bytes_per_second, {100e9}}}};
  run["machine/triad_l2/avx2"] = {.labels = {{"instruction_set", "avx2"},
                                             {"limit", "l2"},
                                             {"array_bytes", "500000"},
                                             {"more_than_bytes", "32000"},
                                             {"up_to_bytes", "1000000"}},
                                  .numbers = {{bytes_per_second, {10e9}}}};
  run["tape/hessian/orbital_transfer/avx2"] = {
      .labels = {{"way", "tape"}, {"instruction_set", "avx2"}, {"intervals", intervals}},
      .numbers = {
          {ns_per_interval, {12.0, 10.0, 16.0}}, {operations_per_interval, {40.0}}, {bytes_per_interval, {80.0}}}};
  return run;
}

TEST(IntervalTable, HasMediansOfTheRepetitions) {
  const Table table = interval_table(run_of("400"));
  ASSERT_EQ(table.rows().size(), 1U);
  const Row& row = table.rows()[0];
  EXPECT_EQ(row.text("way"), "tape");
  EXPECT_EQ(row.text("repetitions"), "3");
  EXPECT_EQ(row.number("nanoseconds"), 12.0);
  EXPECT_EQ(row.number("smallest_nanoseconds"), 10.0);
  EXPECT_EQ(row.number("operations_per_byte"), 0.5);
}

TEST(IntervalTable, TakesTheRoofOfTheLevelThatHoldsAllArrays) {
  const Row near = interval_table(run_of("400")).rows().at(0);  // 32,000 bytes
  EXPECT_EQ(near.text("roof_limit"), "arithmetic");
  EXPECT_DOUBLE_EQ(near.number("roof_nanoseconds").value_or(0.0), 2.0);
  const Row far = interval_table(run_of("401")).rows().at(0);
  EXPECT_EQ(far.text("roof_limit"), "l2");
  EXPECT_DOUBLE_EQ(far.number("roof_nanoseconds").value_or(0.0), 8.0);
  EXPECT_DOUBLE_EQ(far.number("roof_share").value_or(0.0), 8.0 / 12.0);
}

TEST(IntervalTable, HasNoRoofWhereTheMachineWasNotMeasured) {
  Benchmarks run = run_of("401");
  run.erase("machine/triad_l2/avx2");
  EXPECT_EQ(interval_table(run).rows().at(0).text("roof_limit"), "");
  run = run_of("401");
  run.begin()->second.labels["instruction_set"] = "avx512";  // the arithmetic of another set
  EXPECT_EQ(interval_table(run).rows().at(0).text("roof_limit"), "");
  EXPECT_EQ(interval_table(run).rows().at(0).number("nanoseconds"), 12.0);
}

TEST(MachineTable, HasARowPerLimit) {
  const Table table = machine_table(run_of("400"));
  ASSERT_EQ(table.rows().size(), 3U);
  EXPECT_EQ(table.rows()[0].text("limit"), "arithmetic");
  EXPECT_EQ(table.rows()[0].text("array_bytes"), "");
  EXPECT_EQ(table.rows()[1].text("array_bytes"), "16000");
  EXPECT_EQ(table.rows()[1].number("rate"), 100e9);
}

}  // namespace
}  // namespace dmocbench::speed
