// The claims about control spaces: reproduced by tables as they should be, and turned by doctored ones.
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "tests/bench/all_tables_for_claims.hpp"

namespace dmocbench {
namespace {

/// The verdict on the orbit's claim where a table has been doctored by `change` in the rows of a method.
ClaimVerdict verdict_of(const std::string& claim, const std::string& table = "", const std::string& method = "",
                        const std::function<void(Row&)>& change = {}) {
  static const std::map<std::string, tests::Rows> all = tests::all_rows();
  ResultTables results;
  for (const auto& [name, rows_of_name] : all) {
    if (name.find("galerkin") == std::string::npos) continue;
    tests::Rows rows = rows_of_name;
    for (Row& row : rows) {
      if (name == table && row.text("method") == method) change(row);
    }
    results.add(name, tests::declared_table(name, rows));
  }
  for (const JudgedClaim& judged : judge_claims(results)) {
    if (judged.id == std::string(orbit) + "/" + claim) return judged.verdict;
  }
  ADD_FAILURE() << "no claim " << claim;
  return ClaimVerdict::not_judged;
}

auto sets(const char* column, const char* text) {
  return [=](Row& row) { row.set(column, text); };
}

TEST(GalerkinClaims, OnOrdersTurnWithTheSlopesOfTheSpacesThatTheyAreAbout) {
  const std::string table = "convergence_galerkin_slopes";
  for (const auto& [claim, method, other] : {std::tuple("control_space_large_enough", "galerkin_2_3", "galerkin_2_1"),
                                             std::tuple("control_space_too_small", "galerkin_2_1", "galerkin_2_3")}) {
    EXPECT_EQ(verdict_of(claim), ClaimVerdict::reproduced);
    EXPECT_EQ(verdict_of(claim, table, method, sets("slope", "3.0")), ClaimVerdict::differs);
    EXPECT_EQ(verdict_of(claim, table, other, sets("slope", "3.0")), ClaimVerdict::reproduced);
  }
  EXPECT_EQ(verdict_of("control_space_too_small", table, "galerkin_2_1", sets("verdict", "floor")),
            ClaimVerdict::floor);
}

TEST(GalerkinClaims, OnOrdersAreNotTurnedWhereFinerGridsContradictTheRangeOfTheFit) {
  const auto before_the_asymptotics = [](Row& row) {
    row.set("slope", "5.8");
    row.set("fine_end", "orders");
  };
  EXPECT_EQ(
      verdict_of("control_space_too_small", "convergence_galerkin_slopes", "galerkin_2_1", before_the_asymptotics),
      ClaimVerdict::floor);
}

TEST(GalerkinClaims, OnDmocTurnWithAnotherOptimum) {
  const std::string table = "convergence_galerkin";
  EXPECT_EQ(verdict_of("galerkin_is_dmoc"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict_of("galerkin_is_dmoc", table, "galerkin_1_1", sets("objective", "4.001e-5")),
            ClaimVerdict::differs);
  EXPECT_EQ(verdict_of("galerkin_is_dmoc", table, "galerkin_1_1", sets("state_error", "2e-3")), ClaimVerdict::differs);
  EXPECT_EQ(verdict_of("galerkin_is_dmoc", table, "galerkin_1_1", sets("status", "step failed")),
            ClaimVerdict::not_judged);
}

TEST(GalerkinClaims, OnMomentumTurnWithTheLargestDefect) {
  EXPECT_EQ(verdict_of("galerkin_momentum"), ClaimVerdict::reproduced);
  EXPECT_EQ(
      verdict_of("galerkin_momentum", "consistency_galerkin", "galerkin_2_1", sets("momentum_defect_max", "1e-6")),
      ClaimVerdict::differs);
}

}  // namespace
}  // namespace dmocbench
