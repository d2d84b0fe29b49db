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

JudgedClaim judged_cold(const ColdOutcome& outcome, const std::string& id = "cold_starts_confirmed") {
  tests::Rows shares;
  for (const auto& [method, hits] : {std::tuple("dmoc", outcome.dmoc), std::tuple("hamiltonian", outcome.hamiltonian),
                                     std::tuple("tangent", outcome.tangent)}) {
    Row row = tests::scheme_row(method);
    row.set("solver", "interior_point");
    row.set("derivatives", "tape");
    row.set("intervals", 64LL);
    row.set("start_kind", outcome.start_kind);
    row.set("starts", outcome.starts);
    row.set("confirmed", hits);
    row.set("best", hits);
    shares.push_back(row);
  }
  return tests::judged_claim("orbital_transfer/" + id, tests::results_of({{"cold_start_shares", shares}}));
}

ClaimVerdict verdict_cold(const ColdOutcome& outcome) { return judged_cold(outcome).verdict; }

TEST(ColdStartClaims, StateTheDifferencesAndWhatTheirIntervalsSay) {
  const auto says = [](const ColdOutcome& outcome, const char* words) {
    const JudgedClaim claim = judged_cold(outcome);
    return claim.verdict == ClaimVerdict::measured && claim.measured().find(words) != std::string::npos;
  };
  EXPECT_TRUE(says({.dmoc = 950, .hamiltonian = 955, .tangent = 960}, "%: no significant difference; tangent"));
  EXPECT_TRUE(says({.dmoc = 800, .hamiltonian = 800, .tangent = 950}, "DMOC succeeds less often; 95 %"));
  EXPECT_TRUE(says({.dmoc = 950, .hamiltonian = 800, .tangent = 950}, "DMOC succeeds more often; tangent"));
}

TEST(ColdStartClaims, AreNotJudgedByOtherStartsOrImpossibleCounts) {
  EXPECT_EQ(verdict_cold({.dmoc = 950, .hamiltonian = 950, .tangent = 950, .start_kind = "warm"}),
            ClaimVerdict::not_judged);
  EXPECT_EQ(verdict_cold({.dmoc = 1001, .hamiltonian = 950, .tangent = 950}), ClaimVerdict::not_judged);
  EXPECT_EQ(verdict_cold({.dmoc = 0.5, .hamiltonian = 1, .tangent = 1}), ClaimVerdict::not_judged);
  EXPECT_EQ(verdict_cold({.starts = 0.0}), ClaimVerdict::not_judged);
}

TEST(ColdStartClaims, AreOursAndNameTheirStarts) {
  for (const std::string id : {"cold_starts_confirmed", "cold_starts_best"}) {
    const JudgedClaim claim = judged_cold({.dmoc = 950, .hamiltonian = 950, .tangent = 950}, id);
    EXPECT_EQ(claim.whose, Whose::ours);
    EXPECT_NE(claim.states.find("cold"), std::string::npos);
    EXPECT_NE(claim.measured().find("cold"), std::string::npos);
  }
}

}  // namespace
}  // namespace dmocbench
