// The claims about control spaces: reproduced by tables as they should be, and turned by doctored ones.
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "tests/bench/doctored_verdict.hpp"

namespace dmocbench {
namespace {

using tests::sets;

ClaimVerdict verdict_on_spaces(const std::string& claim, const std::string& table = "", const std::string& method = "",
                               const std::function<void(Row&)>& change = {}) {
  return tests::doctored_verdict("galerkin", claim, table, method, change);
}

TEST(GalerkinClaims, OnOrdersTurnWithTheSlopesOfTheSpacesThatTheyAreAbout) {
  const std::string table = "convergence_galerkin_slopes";
  for (const auto& [claim, method, other] : {std::tuple("control_space_large_enough", "galerkin_2_3", "galerkin_2_1"),
                                             std::tuple("control_space_too_small", "galerkin_2_1", "galerkin_2_3")}) {
    EXPECT_EQ(verdict_on_spaces(claim), ClaimVerdict::reproduced);
    EXPECT_EQ(verdict_on_spaces(claim, table, method, sets("slope", "3.0")), ClaimVerdict::differs);
    EXPECT_EQ(verdict_on_spaces(claim, table, other, sets("slope", "3.0")), ClaimVerdict::reproduced);
  }
  EXPECT_EQ(verdict_on_spaces("control_space_too_small", table, "galerkin_2_1", sets("verdict", "floor")),
            ClaimVerdict::floor);
}

TEST(GalerkinClaims, OnOrdersAreNeitherTurnedNorSupportedWhereFinerGridsContradictTheRangeOfTheFit) {
  for (const char* const slope : {"5.8", "2.0"}) {
    const auto before_the_asymptotics = [slope](Row& row) {
      row.set("slope", slope);
      row.set("fine_end", "orders");
    };
    EXPECT_EQ(verdict_on_spaces("control_space_too_small", "convergence_galerkin_slopes", "galerkin_2_1",
                                before_the_asymptotics),
              ClaimVerdict::floor)
        << slope;
  }
}

TEST(GalerkinClaims, OnDmocTurnWithAnotherOptimum) {
  const std::string table = "convergence_galerkin";
  EXPECT_EQ(verdict_on_spaces("galerkin_is_dmoc"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict_on_spaces("galerkin_is_dmoc", table, "galerkin_1_1", sets("objective", "4.001e-5")),
            ClaimVerdict::differs);
  EXPECT_EQ(verdict_on_spaces("galerkin_is_dmoc", table, "galerkin_1_1", sets("state_error", "2e-3")),
            ClaimVerdict::differs);
  EXPECT_EQ(verdict_on_spaces("galerkin_is_dmoc", table, "galerkin_1_1", sets("status", "step failed")),
            ClaimVerdict::not_judged);
}

TEST(GalerkinClaims, OnMomentumTurnWithTheLargestDefect) {
  EXPECT_EQ(verdict_on_spaces("galerkin_momentum"), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict_on_spaces("galerkin_momentum", "consistency_galerkin", "galerkin_2_1",
                              sets("momentum_defect_max", "1e-6")),
            ClaimVerdict::differs);
}

TEST(GalerkinClaims, OnTheControlLagrangianTurnWithOneTripleAndAreUndecidedByATestThatFindsNoMistake) {
  const std::string claim = "variation_and_discretisation_commute";
  EXPECT_EQ(verdict_on_spaces(claim), ClaimVerdict::reproduced);
  for (const auto& [column, number, verdict] :
       {std::tuple("galerkin_form_difference", "1e-9", ClaimVerdict::differs),
        std::tuple("straight_form_difference", "1e-15", ClaimVerdict::undecided)}) {
    EXPECT_EQ(verdict_on_spaces(claim, "equivalence_galerkin_lobatto", "galerkin_2_1", sets(column, number)), verdict);
  }
}

}  // namespace
}  // namespace dmocbench
