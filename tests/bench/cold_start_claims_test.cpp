// The claims about cold starts, on doctored tables.
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "bench/claims/claim.hpp"
#include "tests/bench/declared_tables.hpp"

namespace dmocbench {
namespace {

/// How many of `starts` each method has on the best branch and confirmed.
struct ColdOutcome {
  double dmoc = 0.0;
  double hamiltonian = 0.0;
  double tangent = 0.0;
  double starts = 1000.0;
  const char* start_kind = "cold";
};

JudgedClaim judged_cold(const ColdOutcome& outcome, const std::string& id = "cold_starts_confirmed_as_often") {
  tests::Rows shares;
  for (const auto& [method, hits] : {std::tuple("dmoc", outcome.dmoc), std::tuple("hamiltonian", outcome.hamiltonian),
                                     std::tuple("tangent", outcome.tangent)}) {
    Row row;
    row.set("problem", "orbital_transfer");
    row.set("method", method);
    row.set("tableau", "gauss");
    row.set("stages", 1LL);
    row.set("solver", "interior_point");
    row.set("derivatives", "tape");
    row.set("intervals", 64LL);
    row.set("start_kind", outcome.start_kind);
    row.set("starts", outcome.starts);
    row.set("confirmed", hits);
    row.set("best", hits);
    shares.push_back(row);
  }
  ResultTables results;
  results.add("cold_start_shares", tests::declared_table("cold_start_shares", shares));
  for (const JudgedClaim& claim : judge_claims(results)) {
    if (claim.id == "orbital_transfer/" + id) return claim;
  }
  ADD_FAILURE() << "no claim " << id;
  return {};
}

ClaimVerdict verdict_cold(const ColdOutcome& outcome) { return judged_cold(outcome).verdict; }

TEST(ColdStartClaims, HoldWhereTheIntervalOfTheDifferenceIsWithinTheMargin) {
  EXPECT_EQ(verdict_cold({.dmoc = 950, .hamiltonian = 955, .tangent = 960}), ClaimVerdict::reproduced);
}

TEST(ColdStartClaims, DifferWhereItIsBeyondTheMarginInEitherDirection) {
  EXPECT_EQ(verdict_cold({.dmoc = 800, .hamiltonian = 800, .tangent = 950}), ClaimVerdict::differs);
  EXPECT_EQ(verdict_cold({.dmoc = 950, .hamiltonian = 800, .tangent = 950}), ClaimVerdict::differs);
}

TEST(ColdStartClaims, AreUndecidedWhereTheIntervalHoldsTheMargin) {
  EXPECT_EQ(verdict_cold({.dmoc = 900, .hamiltonian = 950, .tangent = 900}), ClaimVerdict::undecided);
  EXPECT_EQ(verdict_cold({.dmoc = 19, .hamiltonian = 19, .tangent = 19, .starts = 20}), ClaimVerdict::undecided);
}

TEST(ColdStartClaims, AreNotJudgedByOtherStartsOrImpossibleCounts) {
  EXPECT_EQ(verdict_cold({.dmoc = 950, .hamiltonian = 950, .tangent = 950, .start_kind = "warm"}),
            ClaimVerdict::not_yet);
  EXPECT_EQ(verdict_cold({.dmoc = 1001, .hamiltonian = 950, .tangent = 950}), ClaimVerdict::not_yet);
  EXPECT_EQ(verdict_cold({.dmoc = 0.5, .hamiltonian = 1, .tangent = 1}), ClaimVerdict::not_yet);
  EXPECT_EQ(verdict_cold({.starts = 0.0}), ClaimVerdict::not_yet);
}

TEST(ColdStartClaims, AreOursAndNameTheirStarts) {
  for (const std::string id : {"cold_starts_confirmed_as_often", "cold_starts_best_as_often"}) {
    const JudgedClaim claim = judged_cold({.dmoc = 950, .hamiltonian = 950, .tangent = 950}, id);
    EXPECT_EQ(claim.whose, Whose::ours);
    EXPECT_NE(claim.states.find("cold"), std::string::npos);
    EXPECT_NE(claim.measured.find("cold"), std::string::npos);
  }
}

}  // namespace
}  // namespace dmocbench
