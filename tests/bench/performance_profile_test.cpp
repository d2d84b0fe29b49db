#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "bench/tables/profile_tables.hpp"
#include "tests/bench/declared_tables.hpp"

namespace dmocbench {
namespace {

Row solve(const char* problem, const char* method, double seconds, const char* success = "yes") {
  Row row = tests::scheme_row(method, problem);
  row.set("intervals", 32LL);
  row.set("solver", "ipopt");
  row.set("derivatives", "tape");
  row.set("objective", 1.0);
  row.set("seconds", seconds);
  row.set("evaluations", seconds);
  row.set("major_iterations", seconds);
  row.set("success", success);
  return row;
}

/// Four instances: dmoc best on two, tangent on one, one that nobody solves.
Table contest() {
  Table rows({"problem"});
  rows.append(solve("a", "dmoc", 1.0));
  rows.append(solve("a", "tangent", 2.0));
  rows.append(solve("b", "dmoc", 1.0));
  rows.append(solve("b", "tangent", 0.1, "no"));  // fast and wrong
  rows.append(solve("c", "dmoc", 4.0));
  rows.append(solve("c", "tangent", 1.0));
  rows.append(solve("d", "dmoc", 1.0, "no"));
  rows.append(solve("d", "tangent", 1.0, "no"));
  return rows;
}

TEST(PerformanceProfiles, AreSharesOfAllInstancesWhereFailuresNeverArrive) {
  std::map<std::string, std::map<double, double>> share;
  const Table profiles = performance_profiles(contest());
  for (const Row& row : profiles.rows()) {
    if (row.text("measure") == "seconds") share[row.text("method")][row.needed("ratio")] = row.needed("share");
  }
  EXPECT_EQ(share["dmoc"], (std::map<double, double>{{1.0, 0.5}, {4.0, 0.75}}));
  EXPECT_EQ(share["tangent"], (std::map<double, double>{{1.0, 0.25}, {2.0, 0.5}, {4.0, 0.5}}));
}

TEST(ProfileSummary, CountsSuccessesAndWinsAndAveragesWhatAllSolved) {
  const Table table = profile_summary(contest());
  ASSERT_EQ(table.rows().size(), 2U);
  const Row& dmoc = table.rows()[0];
  EXPECT_EQ(dmoc.number("instances"), 4.0);
  EXPECT_EQ(dmoc.number("successes"), 3.0);
  EXPECT_EQ(dmoc.number("common"), 2.0);
  EXPECT_EQ(dmoc.number("wins_seconds"), 2.0);
  // Instances a and c: 1, 4 and 2, 1, whose median is the shift 1.5.
  EXPECT_NEAR(dmoc.needed("seconds"), std::sqrt(2.5 * 5.5) - 1.5, 1e-12);
  EXPECT_NEAR(table.rows()[1].needed("seconds"), std::sqrt(3.5 * 2.5) - 1.5, 1e-12);
}

TEST(ProfileSummary, OfASolverThatDoesNotTellItsIterationsStillCountsItsSuccesses) {
  Table rows({"problem"});
  Row silent = solve("a", "tangent", 2.0);
  silent.set("major_iterations", Cell());
  rows.append(solve("a", "dmoc", 1.0));
  rows.append(silent);
  const Table table = profile_summary(rows);
  EXPECT_EQ(table.rows()[1].number("successes"), 1.0);
  EXPECT_EQ(table.rows()[1].number("common"), 1.0);
  EXPECT_TRUE(table.rows()[1].number("seconds").has_value());
  EXPECT_FALSE(table.rows()[1].number("major_iterations").has_value());
  EXPECT_TRUE(table.rows()[0].number("major_iterations").has_value());
}

}  // namespace
}  // namespace dmocbench
