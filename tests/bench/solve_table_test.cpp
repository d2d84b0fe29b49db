#include "bench/speed/solve_table.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/speed/solve_name.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench::speed {
namespace {

using dmocbench::tests::expect_error_naming;

SolveName orbit(int intervals, const std::string& solver, int threads = 1) {
  return {false, "orbital_transfer", "dmoc", intervals, solver, threads};
}

Solves solved_in(const std::vector<double>& seconds) {
  Solves solves;
  solves.seconds = seconds;
  solves.setup_seconds = {3e-3, 1e-3, 2e-3};
  solves.iterations = 4.0;
  solves.objective = 2.5;
  solves.is_solved = true;
  return solves;
}

/// Ten times as long by Ipopt.
SolvesByName pair_on_1024() {
  SolvesByName solves;
  solves[orbit(1024, "interior_point")] = solved_in({2e-3, 1e-3, 3e-3});
  solves[orbit(1024, "ipopt")] = solved_in({20e-3, 15e-3, 30e-3});
  return solves;
}

TEST(SolveName, IsReadAsItIsWritten) {
  for (const char* text : {"orbital_transfer/dmoc/64/ipopt", "orbital_transfer/tangent/16384/interior_point/threads_2",
                           "library/cart_pole/dmoc/1024/ipopt"}) {
    EXPECT_EQ(SolveName::parse(text).text(), text);
  }
  const SolveName name = SolveName::parse("library/cart_pole/dmoc/1024/ipopt/threads_2");
  EXPECT_TRUE(name.is_of_library);
  EXPECT_EQ(name.problem, "cart_pole");
  EXPECT_EQ(name.method, "dmoc");
  EXPECT_EQ(name.intervals, 1024);
  EXPECT_EQ(name.solver, "ipopt");
  EXPECT_EQ(name.threads, 2);
}

TEST(SolveName, RefusesWhatIsNone) {
  for (const char* text : {"", "library", "orbital_transfer/dmoc/64", "orbital_transfer/dmoc/many/ipopt",
                           "orbital_transfer/dmoc/64/ipopt/threads_0", "orbital_transfer/dmoc/64/ipopt/cold",
                           "orbital_transfer/dmoc/-64/ipopt", "orbital_transfer/dmoc/64x/ipopt"}) {
    expect_error_naming({std::string("\"") + text + "\""}, [&] { (void)SolveName::parse(text); });
  }
}

TEST(SolveTable, HasARowPerBenchmarkWithMedians) {
  SolvesByName solves = pair_on_1024();
  solves[orbit(1024, "interior_point")].linear_systems = 5.0;
  solves[orbit(1024, "interior_point")].bytes_per_interval = 900.0;
  const Table table = solve_rows(solves);
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
  const Table table = solve_rows(pair_on_1024());
  EXPECT_EQ(table.rows()[1].text("linear_systems"), "");
  EXPECT_EQ(table.rows()[1].text("bytes_per_interval"), "");
}

TEST(SolveRatios, StandWhereBothSolvedTheSame) {
  const Table ratios = solve_ratios(pair_on_1024());
  ASSERT_EQ(ratios.rows().size(), 1U);
  EXPECT_EQ(ratios.rows()[0].text("quantity"), "solver");
  EXPECT_EQ(ratios.rows()[0].text("verdict"), "same");
  EXPECT_DOUBLE_EQ(ratios.rows()[0].number("ratio").value_or(0.0), 10.0);
  EXPECT_DOUBLE_EQ(ratios.rows()[0].number("ratio_of_smallest").value_or(0.0), 15.0);
}

TEST(SolveRatios, DoNotStandOnDifferentBranches) {
  SolvesByName solves = pair_on_1024();
  solves[orbit(1024, "ipopt")].objective = 2.5 * (1.0 + 3e-9);
  EXPECT_EQ(solve_ratios(solves).rows()[0].text("verdict"), "other branch");
  EXPECT_EQ(solve_ratios(solves).rows()[0].text("ratio"), "");
  solves[orbit(1024, "ipopt")].objective = 2.5 * (1.0 + 3e-10);
  EXPECT_EQ(solve_ratios(solves).rows()[0].text("verdict"), "same");
}

TEST(SolveRatios, DoNotStandWhereOneFailed) {
  SolvesByName solves = pair_on_1024();
  solves[orbit(1024, "interior_point")].is_solved = false;
  EXPECT_EQ(solve_ratios(solves).rows()[0].text("verdict"), "not both solved");
  EXPECT_EQ(solve_ratios(solves).rows()[0].text("ratio"), "");
}

TEST(SolveRatios, CompareOneThreadWithTwo) {
  SolvesByName solves;
  solves[orbit(16384, "interior_point")] = solved_in({18e-3});
  solves[orbit(16384, "interior_point", 2)] = solved_in({10e-3});
  const Table ratios = solve_ratios(solves);
  ASSERT_EQ(ratios.rows().size(), 1U);
  EXPECT_EQ(ratios.rows()[0].text("quantity"), "threads");
  EXPECT_DOUBLE_EQ(ratios.rows()[0].number("ratio").value_or(0.0), 1.8);
}

/// Time per iteration 1e-7 N^1.05 s, whatever the number of iterations.
SolvesByName power_law(const std::vector<int>& grids) {
  SolvesByName solves;
  for (const int intervals : grids) {
    Solves& one = solves[orbit(intervals, "interior_point")] = solved_in({});
    one.iterations = 3.0 + intervals % 7;
    one.seconds = {one.iterations * 1e-7 * std::pow(intervals, 1.05)};
  }
  return solves;
}

TEST(SolveExponents, AreThoseOfTheTimePerIteration) {
  const Table exponents = solve_exponents(power_law({1024, 16384, 65536, 1048576}));
  ASSERT_EQ(exponents.rows().size(), 1U);
  const Row& row = exponents.rows()[0];
  EXPECT_NEAR(row.number("exponent").value_or(0.0), 1.05, 1e-12);
  EXPECT_EQ(row.text("grids"), "4");
  EXPECT_EQ(row.text("coarsest"), "1024");
  EXPECT_EQ(row.text("finest"), "1048576");
}

TEST(SolveExponents, LeaveOutShortGridsAndWhatFailed) {
  SolvesByName solves = power_law({64, 1024, 16384, 65536, 262144});
  solves[orbit(64, "interior_point")].seconds = {1.0};
  solves[orbit(65536, "interior_point")].seconds = {100.0};
  solves[orbit(65536, "interior_point")].is_solved = false;
  const Table exponents = solve_exponents(solves);
  ASSERT_EQ(exponents.rows().size(), 1U);
  EXPECT_NEAR(exponents.rows()[0].number("exponent").value_or(0.0), 1.05, 1e-12);
  EXPECT_EQ(exponents.rows()[0].text("grids"), "3");
}

TEST(SolveExponents, NeedThreeGrids) { EXPECT_TRUE(solve_exponents(power_law({64, 1024, 16384})).rows().empty()); }

TEST(SolveSummary, SaysRatiosAndWhyThereIsNone) {
  SolvesByName solves = pair_on_1024();
  EXPECT_NE(solve_summary(solves).find("10.0 (15.0)"), std::string::npos);
  solves[orbit(1024, "ipopt")].objective = 3.0;
  EXPECT_NE(solve_summary(solves).find("other branch"), std::string::npos);
  EXPECT_EQ(solve_summary(solves).find("exponent"), std::string::npos);
  EXPECT_NE(solve_summary(power_law({1024, 16384, 65536})).find("exponent"), std::string::npos);
}

TEST(SolveSummary, SurvivesASolverAlone) {
  SolvesByName solves;
  solves[orbit(1024, "ipopt")] = solved_in({1.0});
  EXPECT_NE(solve_summary(solves).find("orbital_transfer dmoc N = 1024"), std::string::npos);
}

}  // namespace
}  // namespace dmocbench::speed
