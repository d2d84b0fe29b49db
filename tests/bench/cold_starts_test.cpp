#include "bench/tables/cold_starts.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "bench/tables/ratio_interval.hpp"
#include "tests/bench/declared_tables.hpp"

namespace dmocbench {
namespace {

Row cold_answer(const char* problem, const char* method, const char* status, double objective, double evaluations) {
  Row row = tests::scheme_row(method, problem);
  row.set("solver", "interior_point");
  row.set("derivatives", "tape");
  row.set("intervals", 64LL);
  row.set("status", status);
  row.set("objective", objective);
  row.set("major_iterations", evaluations / 5.0);
  row.set("evaluations", evaluations);
  row.set("seconds", evaluations / 1000.0);
  return row;
}

/// DMOC: two on the best branch, one elsewhere, one too coarse, two lost; tangent: one lower than the tolerance
/// explains.
Table cold_answers() {
  Table table;
  table.append(cold_answer("p", "dmoc", "solved", 100.0, 50.0));
  table.append(cold_answer("p", "dmoc", "solved", 101.0, 100.0));
  table.append(cold_answer("p", "dmoc", "solved", 120.0, 60.0));
  table.append(cold_answer("p", "dmoc", "too coarse", 80.0, 70.0));
  table.append(cold_answer("p", "dmoc", "acceptable", 100.0, 300.0));
  table.append(cold_answer("p", "dmoc", "iteration limit", 99.0, 900.0));
  table.append(cold_answer("p", "tangent", "solved", 95.0, 80.0));
  table.append(cold_answer("p", "tangent", "solved", 100.5, 40.0));
  return table;
}

Table cold_answers_with(double reference) {
  Table table;
  const Table all = cold_answers();
  for (Row row : all.rows()) {
    row.set("reference_objective", reference);
    table.append(std::move(row));
  }
  return table;
}

TEST(ColdStartShares, CountEveryStartOnce) {
  const Table shares = cold_start_shares(cold_answers_with(100.0), 0.02);
  ASSERT_EQ(shares.rows().size(), 2U);
  for (const Row& row : shares.rows()) {
    EXPECT_EQ(row.needed("best") + row.needed("elsewhere"), row.needed("confirmed"));
    EXPECT_EQ(row.needed("confirmed") + row.needed("too_coarse"), row.needed("solved"));
    EXPECT_EQ(row.needed("solved") + row.needed("lost"), row.needed("starts"));
    EXPECT_EQ(row.text("start_kind"), "cold");
  }
  const Row& dmoc = shares.rows().front();
  EXPECT_EQ(dmoc.needed("starts"), 6.0);
  EXPECT_EQ(dmoc.needed("best"), 2.0);
  EXPECT_EQ(dmoc.needed("elsewhere"), 1.0);
  EXPECT_EQ(dmoc.needed("too_coarse"), 1.0);
  EXPECT_EQ(dmoc.needed("lost"), 2.0);
}

TEST(ColdStartShares, CallNothingSolvedThatIsOnlyAcceptableAndNameEveryFailure) {
  const Table shares = cold_start_shares(cold_answers_with(100.0), 0.02);
  EXPECT_EQ(shares.rows()[0].text("failures"), "acceptable 1, iteration limit 1");
  EXPECT_EQ(shares.rows()[1].text("failures"), "");
}

TEST(ColdStartShares, AreOfAllStartsWithWilsonsInterval) {
  const Table shares = cold_start_shares(cold_answers_with(100.0), 0.02);
  const Row& row = shares.rows().front();
  const ShareInterval interval = wilson_interval({.hits = 2, .trials = 6});
  EXPECT_DOUBLE_EQ(row.needed("best_share"), 2.0 / 6.0);
  EXPECT_DOUBLE_EQ(row.needed("best_lower"), interval.lower);
  EXPECT_DOUBLE_EQ(row.needed("best_upper"), interval.upper);
}

TEST(ColdStartShares, TellWhatIsConfirmedBelowTheReference) {
  const Table shares = cold_start_shares(cold_answers_with(100.0), 0.02);
  EXPECT_EQ(shares.rows()[0].needed("below_reference"), 0.0);
  EXPECT_EQ(shares.rows()[1].needed("below_reference"), 1.0);
  EXPECT_EQ(shares.rows()[1].needed("best"), 2.0);
}

TEST(ColdStartShares, TakeTheLowestConfirmedCostOfAnyMethodWhereNothingIsCertified) {
  const Table shares = cold_start_shares(cold_answers(), 0.02);
  for (const Row& row : shares.rows()) {
    EXPECT_EQ(row.needed("reference_objective"), 95.0);
    EXPECT_EQ(row.text("reference_kind"), "lowest confirmed");
  }
  EXPECT_EQ(shares.rows()[0].needed("best"), 0.0);
  EXPECT_EQ(shares.rows()[1].needed("best"), 1.0);
}

TEST(ColdStartShares, TakeTheLowestConfirmedCostWhereNoneReachesTheCertifiedOne) {
  const Table shares = cold_start_shares(cold_answers_with(40.0), 0.02);
  for (const Row& row : shares.rows()) {
    EXPECT_EQ(row.needed("certified_objective"), 40.0);
    EXPECT_EQ(row.needed("reference_objective"), 95.0);
    EXPECT_EQ(row.text("reference_kind"), "lowest confirmed");
  }
}

TEST(ColdStartShares, HaveQuartilesOfTheBestAnswersOnly) {
  const Table shares = cold_start_shares(cold_answers_with(100.0), 0.02);
  const Row& dmoc = shares.rows().front();
  EXPECT_DOUBLE_EQ(dmoc.needed("evaluations_lower_quartile"), 62.5);
  EXPECT_DOUBLE_EQ(dmoc.needed("evaluations_median"), 75.0);
  EXPECT_DOUBLE_EQ(dmoc.needed("evaluations_upper_quartile"), 87.5);
  EXPECT_DOUBLE_EQ(dmoc.needed("iterations_median"), 15.0);
}

TEST(ColdStartShares, LeaveQuartilesEmptyWhereNothingIsTheBest) {
  Table lost;
  lost.append(cold_answer("p", "dmoc", "step failed", 1.0, 5.0));
  const Table shares = cold_start_shares(lost, 0.02);
  const Row& row = shares.rows().front();
  EXPECT_EQ(row.text("evaluations_median"), "");
  EXPECT_EQ(row.text("reference_kind"), "none");
  EXPECT_EQ(row.needed("best_share"), 0.0);
}

TEST(ColdStartProfiles, RiseToTheShareThatIsConfirmed) {
  const Table shares = cold_start_shares(cold_answers_with(100.0), 0.02);
  const Table profiles = cold_start_profiles(cold_answers_with(100.0));
  for (const std::string measure : {"evaluations", "seconds"}) {
    for (const Row& cell : shares.rows()) {
      const Selection curve = Selection(profiles).where("measure", measure).where("method", cell.text("method"));
      ASSERT_FALSE(curve.empty());
      double share = 0.0;
      double budget = 0.0;
      for (const Row& point : curve) {
        EXPECT_GE(point.needed("share"), share);
        EXPECT_GT(point.needed("budget"), budget);
        share = point.needed("share");
        budget = point.needed("budget");
      }
      EXPECT_DOUBLE_EQ(share, cell.needed("confirmed_share"));
    }
  }
}

TEST(ColdStartProfiles, GiveEveryProblemTheSameWeight) {
  Table table;
  for (int i = 0; i < 9; ++i) table.append(cold_answer("hard", "dmoc", "step failed", 1.0, 5.0));
  table.append(cold_answer("easy", "dmoc", "solved", 1.0, 10.0));
  const Table profiles = cold_start_profiles(table);
  const Selection mean = Selection(profiles).where("problem", every_problem).where("measure", "evaluations");
  ASSERT_FALSE(mean.empty());
  EXPECT_DOUBLE_EQ(mean.back().needed("share"), 0.5);
}

TEST(ColdStartProfiles, StayShortHoweverManyStartsThereAre) {
  Table table;
  for (int i = 1; i <= 1000; ++i) table.append(cold_answer("p", "dmoc", "solved", 1.0, i));
  const Table profiles = cold_start_profiles(table);
  const Selection curve = Selection(profiles).where("measure", "evaluations");
  EXPECT_LE(curve.size(), 100U);
  EXPECT_EQ(curve.front().needed("budget"), 1.0);
  EXPECT_EQ(curve.back().needed("budget"), 1000.0);
  for (const Row& point : curve) EXPECT_DOUBLE_EQ(point.needed("share"), point.needed("budget") / 1000.0);
}

}  // namespace
}  // namespace dmocbench
