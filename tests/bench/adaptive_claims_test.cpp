// The claims about adapted grids, on doctored tables.
#include <string>

#include <gtest/gtest.h>

#include "bench/claims/claim.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/bench/declared_tables.hpp"

namespace dmocbench {
namespace {

/// What the tables say that decides.
struct AdaptiveOutcome {
  double effectivity = 1.1;
  const char* verdict = "measured";
  double relative_error = 1e-4;
  double uniform = 900.0;
  double adapted = 150.0;
  const char* status = "solved";
  double tangent_variables = 2.0;
};

ResultTables tables_of(const AdaptiveOutcome& outcome) {
  tests::Rows effectivities;
  tests::Rows grids;
  for (const std::string& method : paper_families()) {
    Row row = tests::scheme_row(method, "hypersensitive", 2);
    Row effectivity = row;
    effectivity.set("status", "solved");
    effectivity.set("quantity", "state");
    effectivity.set("effectivity", method == "dmoc" ? outcome.effectivity : 1.0);
    effectivity.set("relative_error", method == "dmoc" ? outcome.relative_error : 1e-4);
    effectivity.set("verdict", method == "dmoc" ? outcome.verdict : "measured");
    effectivities.push_back(effectivity);
    for (const std::string grid : {"uniform", "adapted"}) {
      row.set("grid", grid);
      row.set("status", outcome.status);
      row.set("intervals", grid == "uniform" ? outcome.uniform : outcome.adapted);
      row.set("variables_at_accuracy", method == "dmoc" ? 1.0 : method == "tangent" ? outcome.tangent_variables : 1.6);
      grids.push_back(row);
    }
  }
  return tests::results_of({{"adaptive_effectivity", effectivities}, {"adaptive", grids}});
}

ClaimVerdict effective(const AdaptiveOutcome& outcome) {
  return tests::judged_claim("examples/error_estimate_is_effective", tables_of(outcome)).verdict;
}
ClaimVerdict fewer(const AdaptiveOutcome& outcome) {
  return tests::judged_claim("hypersensitive/adapted_grids_need_fewer_intervals", tables_of(outcome)).verdict;
}
ClaimVerdict ahead(const AdaptiveOutcome& outcome) {
  return tests::judged_claim("hypersensitive/dmoc_keeps_its_advantage_on_adapted_grids", tables_of(outcome)).verdict;
}

TEST(AdaptiveClaims, HoldByTablesThatSayTheSame) {
  for (const auto verdict : {effective({}), ahead({})}) EXPECT_EQ(verdict, ClaimVerdict::reproduced);
  EXPECT_EQ(fewer({}), ClaimVerdict::measured);
}

TEST(AdaptiveClaims, DifferWhereOneEffectivityIsOutside) {
  EXPECT_EQ(effective({.effectivity = 0.29}), ClaimVerdict::differs);
  EXPECT_EQ(effective({.effectivity = 3.1}), ClaimVerdict::differs);
  EXPECT_EQ(effective({.effectivity = 30.0, .verdict = "floor"}), ClaimVerdict::reproduced);
  EXPECT_EQ(effective({.effectivity = 30.0, .relative_error = 0.1}), ClaimVerdict::reproduced);
  EXPECT_EQ(effective({.effectivity = -1.0}), ClaimVerdict::not_judged);
}

TEST(AdaptiveClaims, StateHowManyTimesAsManyIntervalsUniformGridsNeed) {
  const std::string measured =
      tests::judged_claim("hypersensitive/adapted_grids_need_fewer_intervals", tables_of({.uniform = 600.0}))
          .measured();
  EXPECT_NE(measured.find("150 (s = 2) instead of 600 (s = 2), ratio 4.00"), std::string::npos) << measured;
  EXPECT_EQ(fewer({.adapted = 0.0}), ClaimVerdict::not_judged);
}

TEST(AdaptiveClaims, AreNotJudgedWhereNothingReachedTheAccuracy) {
  EXPECT_EQ(fewer({.status = "step failed"}), ClaimVerdict::not_judged);
  EXPECT_EQ(ahead({.status = "step failed"}), ClaimVerdict::not_judged);
}

TEST(AdaptiveClaims, DifferWhereAKindOfCollocationNeedsNoMoreVariables) {
  EXPECT_EQ(ahead({.tangent_variables = 0.99}), ClaimVerdict::differs);
  EXPECT_EQ(ahead({.tangent_variables = 1.01}), ClaimVerdict::reproduced);
}

TEST(AdaptiveClaims, AreAboutAnExtension) {
  for (const char* id : {"examples/error_estimate_is_effective", "hypersensitive/adapted_grids_need_fewer_intervals"}) {
    EXPECT_EQ(tests::judged_claim(id, tables_of({})).whose, Whose::extension);
  }
}

}  // namespace
}  // namespace dmocbench
