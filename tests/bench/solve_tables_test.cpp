#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/speed/speed_tables.hpp"

namespace dmocbench::speed {
namespace {

std::string orbit(int intervals, const std::string& solver, int threads = 1) {
  return fmt::format("{}/{}/{}", intervals, solver, threads);
}

/// Adds a benchmark of the orbit by DMOC.
Benchmark& add(Benchmarks& benchmarks, int intervals, const std::string& solver, int threads,
               const std::vector<double>& seconds) {
  Benchmark& benchmark = benchmarks[orbit(intervals, solver, threads)];
  benchmark.labels = {{"problem", "orbital_transfer"},
                      {"method", "dmoc"},
                      {"intervals", std::to_string(intervals)},
                      {"solver", solver},
                      {"threads", std::to_string(threads)}};
  for (const double each : seconds) benchmark.numbers["real_time"].push_back(1e9 * each);
  benchmark.numbers["setup_seconds"] = {3e-3, 1e-3, 2e-3};
  benchmark.numbers["major_iterations"] = {4.0, 4.0, 4.0};
  benchmark.numbers["objective"] = {2.5};
  benchmark.numbers["solved"] = {1.0, 1.0, 1.0};
  return benchmark;
}

/// Ten times as long by Ipopt.
Benchmarks pair_on_1024() {
  Benchmarks benchmarks;
  add(benchmarks, 1024, "interior_point", 1, {2e-3, 1e-3, 3e-3});
  add(benchmarks, 1024, "ipopt", 1, {20e-3, 15e-3, 30e-3});
  return benchmarks;
}

/// Time per iteration 1e-7 N^1.05 s, whatever the number of iterations.
Benchmarks power_law(const std::vector<int>& grids) {
  Benchmarks benchmarks;
  for (const int intervals : grids) {
    const double iterations = 3.0 + intervals % 7;
    add(benchmarks, intervals, "interior_point", 1, {iterations * 1e-7 * std::pow(intervals, 1.05)})
        .numbers["major_iterations"] = {iterations};
  }
  return benchmarks;
}

Table ratios_of(const Benchmarks& benchmarks) { return solve_ratios(solve_table(benchmarks)); }
Table exponents_of(const Benchmarks& benchmarks) { return solve_exponents(solve_table(benchmarks)); }

TEST(SolveTable, HasARowPerBenchmarkWithMedians) {
  Benchmarks benchmarks = pair_on_1024();
  benchmarks[orbit(1024, "interior_point")].numbers["linear_systems"] = {5.0};
  benchmarks[orbit(1024, "interior_point")].numbers["bytes_per_interval"] = {900.0};
  const Table table = solve_table(benchmarks);
  ASSERT_EQ(table.rows().size(), 2U);
  const Row& row = table.rows()[0];
  EXPECT_EQ(row.text("problem"), "orbital_transfer");
  EXPECT_EQ(row.text("solver"), "interior_point");
  EXPECT_EQ(row.text("threads"), "1");
  EXPECT_EQ(row.text("repetitions"), "3");
  EXPECT_EQ(row.text("solved"), "1");
  EXPECT_DOUBLE_EQ(row.number("seconds").value_or(0.0), 2e-3);
  EXPECT_DOUBLE_EQ(row.number("smallest_seconds").value_or(0.0), 1e-3);
  EXPECT_DOUBLE_EQ(row.number("setup_seconds").value_or(0.0), 2e-3);
  EXPECT_DOUBLE_EQ(row.number("ns_per_interval_iteration").value_or(0.0), 1e9 * 2e-3 / 1024 / 4);
  EXPECT_DOUBLE_EQ(row.number("linear_systems").value_or(0.0), 5.0);
  EXPECT_DOUBLE_EQ(row.number("bytes_per_interval").value_or(0.0), 900.0);
}

TEST(SolveTable, LeavesEmptyWhatIsNotTold) {
  const Table table = solve_table(pair_on_1024());
  EXPECT_EQ(table.rows()[1].text("linear_systems"), "");
  EXPECT_EQ(table.rows()[1].text("bytes_per_interval"), "");
}

TEST(SolveTable, GoesFromCoarseGridsToFine) {
  const Table table = solve_table(power_law({1024, 64, 16384}));
  ASSERT_EQ(table.rows().size(), 3U);
  EXPECT_EQ(table.rows()[0].text("intervals"), "64");
  EXPECT_EQ(table.rows()[2].text("intervals"), "16384");
}

TEST(SolveRatios, StandWhereBothSolvedTheSame) {
  const Table ratios = ratios_of(pair_on_1024());
  ASSERT_EQ(ratios.rows().size(), 1U);
  EXPECT_EQ(ratios.rows()[0].text("quantity"), "solver");
  EXPECT_EQ(ratios.rows()[0].text("verdict"), "same");
  EXPECT_DOUBLE_EQ(ratios.rows()[0].number("ratio").value_or(0.0), 10.0);
  EXPECT_DOUBLE_EQ(ratios.rows()[0].number("ratio_of_smallest").value_or(0.0), 15.0);
}

TEST(SolveRatios, DoNotStandOnDifferentBranches) {
  Benchmarks benchmarks = pair_on_1024();
  benchmarks[orbit(1024, "ipopt")].numbers["objective"] = {2.5 * (1.0 + 3e-9)};
  EXPECT_EQ(ratios_of(benchmarks).rows()[0].text("verdict"), "other branch");
  EXPECT_EQ(ratios_of(benchmarks).rows()[0].text("ratio"), "");
  benchmarks[orbit(1024, "ipopt")].numbers["objective"] = {2.5 * (1.0 + 3e-10)};
  EXPECT_EQ(ratios_of(benchmarks).rows()[0].text("verdict"), "same");
}

TEST(SolveRatios, DoNotStandWhereOneFailed) {
  Benchmarks benchmarks = pair_on_1024();
  benchmarks[orbit(1024, "interior_point")].numbers["solved"] = {1.0, 0.0, 1.0};
  EXPECT_EQ(ratios_of(benchmarks).rows()[0].text("verdict"), "not both solved");
  EXPECT_EQ(ratios_of(benchmarks).rows()[0].text("ratio"), "");
}

TEST(SolveRatios, CompareOneThreadWithTwo) {
  Benchmarks benchmarks;
  add(benchmarks, 16384, "interior_point", 1, {18e-3});
  add(benchmarks, 16384, "interior_point", 2, {10e-3});
  const Table ratios = ratios_of(benchmarks);
  ASSERT_EQ(ratios.rows().size(), 1U);
  EXPECT_EQ(ratios.rows()[0].text("quantity"), "threads");
  EXPECT_DOUBLE_EQ(ratios.rows()[0].number("ratio").value_or(0.0), 1.8);
}

TEST(SolveExponents, AreThoseOfTheTimePerIteration) {
  const Table exponents = exponents_of(power_law({1024, 16384, 65536, 1048576}));
  ASSERT_EQ(exponents.rows().size(), 1U);
  const Row& row = exponents.rows()[0];
  EXPECT_NEAR(row.number("exponent").value_or(0.0), 1.05, 1e-12);
  EXPECT_EQ(row.text("grids"), "4");
  EXPECT_EQ(row.text("coarsest"), "1024");
  EXPECT_EQ(row.text("finest"), "1048576");
}

TEST(SolveExponents, LeaveOutShortGridsAndWhatFailed) {
  Benchmarks benchmarks = power_law({64, 1024, 16384, 65536, 262144});
  benchmarks[orbit(64, "interior_point")].numbers["real_time"] = {1e9};
  benchmarks[orbit(65536, "interior_point")].numbers["real_time"] = {100e9};
  benchmarks[orbit(65536, "interior_point")].numbers["solved"] = {0.0};
  const Table exponents = exponents_of(benchmarks);
  ASSERT_EQ(exponents.rows().size(), 1U);
  EXPECT_NEAR(exponents.rows()[0].number("exponent").value_or(0.0), 1.05, 1e-12);
  EXPECT_EQ(exponents.rows()[0].text("grids"), "3");
}

TEST(SolveExponents, NeedThreeGrids) { EXPECT_TRUE(exponents_of(power_law({64, 1024, 16384})).rows().empty()); }

}  // namespace
}  // namespace dmocbench::speed
