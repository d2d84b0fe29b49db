// The claims about shooting: reproduced by tables as they should be, and turned by doctored ones.
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "tests/bench/doctored_verdict.hpp"

namespace dmocbench {
namespace {

const std::string by_nodes = "multiple_shooting_rk4_1";
const std::string by_midpoint = "multiple_shooting_midpoint_1";
const std::string by_controls = "single_shooting_rk4_1";

using tests::sets;

ClaimVerdict verdict_on_shooting(const std::string& claim, const std::string& table = "",
                                 const std::string& method = "", const std::function<void(Row&)>& change = {}) {
  return tests::doctored_verdict("shooting", claim, table, method, change);
}

TEST(ShootingClaims, OnTheOrderTurnWithTheSlopeOfAnyIntegrator) {
  const std::string claim = "order_of_shooting";
  EXPECT_EQ(verdict_on_shooting(claim), ClaimVerdict::reproduced);
  for (const auto& [table, method] :
       {std::pair("convergence_shooting_slopes", by_nodes), std::pair("convergence_shooting_slopes", by_midpoint),
        std::pair("convergence_shooting_two_stages_slopes", by_nodes)}) {
    EXPECT_EQ(verdict_on_shooting(claim, table, method, sets("slope", "3.0")), ClaimVerdict::differs);
    EXPECT_EQ(verdict_on_shooting(claim, table, method, sets("verdict", "floor")), ClaimVerdict::floor);
    EXPECT_EQ(verdict_on_shooting(claim, table, method, sets("stages", "3")), ClaimVerdict::not_judged);
  }
}

TEST(ShootingClaims, OnColdStartsTurnWithTheCountsAndAreUndecidedNearEqualOnes) {
  const char* const table = "cold_start_shooting_shares";
  for (const auto& [claim, weaker] : {std::pair("multiple_shooting_more_robust_than_single", by_controls),
                                      std::pair("dmoc_more_robust_than_multiple_shooting", by_nodes)}) {
    EXPECT_EQ(verdict_on_shooting(claim), ClaimVerdict::reproduced);
    EXPECT_EQ(verdict_on_shooting(claim, table, weaker, sets("confirmed", "50")),
              weaker == by_nodes ? ClaimVerdict::undecided : ClaimVerdict::differs);
    EXPECT_EQ(verdict_on_shooting(claim, table, weaker, sets("solved", "50")),
              weaker == by_nodes ? ClaimVerdict::undecided : ClaimVerdict::differs)
        << "confirmed less often, but solved as often";
    EXPECT_EQ(verdict_on_shooting(claim, table, weaker, sets("confirmed", "51")), ClaimVerdict::not_judged);
  }
  const std::string claim = "multiple_shooting_more_robust_than_single";
  EXPECT_EQ(verdict_on_shooting(claim, table, by_controls, sets("confirmed", "33")), ClaimVerdict::undecided);
  EXPECT_EQ(verdict_on_shooting(claim, table, by_nodes, sets("intervals", "64")), ClaimVerdict::not_judged);
}

TEST(ShootingClaims, OnCostTurnWithTheTimesAndNeedRoundsAndAnErrorThatBothReach) {
  const char* const table = "savings_by_solver_shooting";
  for (const auto& [claim, method] : {std::pair("multiple_shooting_slower_at_equal_error", by_nodes),
                                      std::pair("single_shooting_slower_at_equal_error", by_controls)}) {
    EXPECT_EQ(verdict_on_shooting(claim), ClaimVerdict::reproduced);
    const auto takes = [](double seconds) {
      return [=](Row& row) { row.set("round_seconds", tests::rounds_around(seconds * row.needed("intervals"))); };
    };
    EXPECT_EQ(verdict_on_shooting(claim, table, method, takes(2e-5)), ClaimVerdict::differs);
    EXPECT_EQ(verdict_on_shooting(claim, table, method, sets("round_seconds", "0.1")), ClaimVerdict::undecided);
    EXPECT_EQ(verdict_on_shooting(claim, table, method, sets("round_seconds", "")), ClaimVerdict::not_judged);
    EXPECT_EQ(verdict_on_shooting(claim, table, method, sets("objective_error", "10")), ClaimVerdict::not_judged);
    EXPECT_EQ(verdict_on_shooting(claim, table, method, sets("branch", "other")), ClaimVerdict::not_judged);
  }
}

TEST(ShootingClaims, OnCostCompareTimesWhereErrorsAreEqualAndNotOnEqualGrids) {
  const auto takes = [](double seconds) {  // 4/N² where DMOC has 1/N²
    return [=](Row& row) {
      row.set("objective_error", 2.0 * row.needed("objective_error"));
      row.set("round_seconds", tests::rounds_around(seconds * row.needed("intervals")));
    };
  };
  const auto verdict = [&](double seconds) {
    return verdict_on_shooting("multiple_shooting_slower_at_equal_error", "savings_by_solver_shooting", by_nodes,
                               takes(seconds));
  };
  EXPECT_EQ(verdict(0.6e-4), ClaimVerdict::reproduced);  // 0.6 times DMOC's on every grid
  EXPECT_EQ(verdict(0.4e-4), ClaimVerdict::differs);
}

}  // namespace
}  // namespace dmocbench
