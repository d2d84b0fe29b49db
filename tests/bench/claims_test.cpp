// Claims are judged by predicates on tables; doctored tables have to be caught.
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "bench/claims/claim.hpp"
#include "tests/bench/tables_for_claims.hpp"

namespace dmocbench {
namespace {

using tests::differences;
using tests::solved_row;
using tests::tables;

ClaimVerdict verdict_on(const std::string& claim, const ResultTables& results) {
  return tests::judged_claim(std::string(orbit) + "/" + claim, results).verdict;
}

bool is(const Row& row, const std::string& method) { return row.text("method") == method; }

TEST(Claims, TablesThatAgreeWithThePaperAreReproduced) {
  for (const char* claim :
       {"state_slope", "control_slope", "momentum_consistency", "equal_solutions", "tangent_differs", "variable_ratio",
        "objective_evolution", "order_of_convergence", "order_of_adjoint_scheme", "reference_step",
        "minor_iteration_ratio", "minor_iterations_equal_variable_ratio", "minor_iterations_saved_in_phase_1",
        "automatic_differentiation_more_robust", "automatic_differentiation_faster",
        "automatic_differentiation_saves_time", "replay_beside_tangent"}) {
    EXPECT_EQ(verdict_on(claim, tables()), ClaimVerdict::reproduced) << claim;
  }
}

TEST(Claims, StageControlsAndAConstantMassAreJudgedOnTheirOwnProblems) {
  const auto judged = [](double slope, double difference) {
    Row row = tests::scheme_row("dmoc");
    row.set("problem", "two_link_manipulator");
    row.set("quantity", "control");
    row.set("stages", 2LL);
    row.set("slope", slope);
    row.set("standard_error", 0.02);
    row.set("verdict", "slope");
    Row solve = solved_row("tangent", 64);
    solve.set("problem", "forced_oscillator");
    for (const char* column : {"configuration_difference", "momentum_difference", "control_difference",
                               "costate_difference", "objective_difference"}) {
      solve.set(column, difference);
    }
    std::map<std::string, ClaimVerdict> verdicts;
    for (const JudgedClaim& claim :
         judge_claims(tests::results_of({{"convergence_indirect_slopes", {row}}, {"equivalence", {solve}}})))
      verdicts[claim.id()] = claim.verdict;
    return verdicts;
  };
  auto good = judged(2.95, 1e-13);
  EXPECT_EQ(good["two_link_manipulator/order_of_stage_controls"], ClaimVerdict::reproduced);
  EXPECT_EQ(good["forced_oscillator/tangent_coincides"], ClaimVerdict::reproduced);
  auto bad = judged(4.0, 1e-6);
  EXPECT_EQ(bad["two_link_manipulator/order_of_stage_controls"], ClaimVerdict::differs);
  EXPECT_EQ(bad["forced_oscillator/tangent_coincides"], ClaimVerdict::differs);
}

TEST(Claims, WithoutTablesNothingIsReproducedOrRefuted) {
  for (const JudgedClaim& claim : judge_claims(ResultTables()))
    EXPECT_EQ(claim.verdict, ClaimVerdict::not_judged) << claim.id();
}

TEST(Claims, OrdersOneAndThreeDiffer) {
  for (const double slope : {1.0, 3.0, 1.85, 2.15}) {
    const ResultTables doctored = tables("convergence_slopes", [&](Row& row) {
      if (is(row, "hamiltonian")) row.set("slope", slope);
    });
    EXPECT_EQ(verdict_on("state_slope", doctored), ClaimVerdict::differs) << slope;
    EXPECT_EQ(verdict_on("control_slope", doctored), ClaimVerdict::differs) << slope;
  }
}

TEST(Claims, ACurveWithoutAnOrderIsNoEvidence) {
  EXPECT_EQ(verdict_on("state_slope", tables("convergence_slopes", [](Row& row) { row.set("slope", Cell()); })),
            ClaimVerdict::not_judged);
}

TEST(Claims, ASlopeIsJudgedTogetherWithItsInterval) {
  const auto judged = [](double slope, double standard_error) {
    return verdict_on("state_slope", tables("convergence_slopes", [&](Row& row) {
                        row.set("slope", slope);
                        row.set("standard_error", standard_error);
                      }));
  };
  EXPECT_EQ(judged(2.05, 0.01), ClaimVerdict::reproduced);
  EXPECT_EQ(judged(2.2, 0.01), ClaimVerdict::differs);
  EXPECT_EQ(judged(2.05, 0.05), ClaimVerdict::undecided) << "the interval reaches out of the band";
  EXPECT_EQ(judged(2.2, 0.1), ClaimVerdict::undecided) << "the interval reaches into the band";
  EXPECT_EQ(judged(2.0, 1.0), ClaimVerdict::undecided) << "a fit that says nothing";
  EXPECT_EQ(judged(1.0, 0.1), ClaimVerdict::differs);
  EXPECT_EQ(judged(3.0, 0.1), ClaimVerdict::differs);
}

TEST(Claims, AMomentumDefectAboveRoundingDiffers) {
  for (const char* method : {"dmoc", "hamiltonian"}) {
    const ResultTables doctored = tables("consistency", [&](Row& row) {
      if (is(row, method) && row.text("intervals") == "1024") row.set("momentum_defect_max", 1e-8);
    });
    EXPECT_EQ(verdict_on("momentum_consistency", doctored), ClaimVerdict::differs) << method;
  }
}

TEST(Claims, ATangentSpaceMethodThatKeepsTheBalanceDiffers) {
  const ResultTables doctored = tables("consistency", [](Row& row) { row.set("momentum_defect_total", 1e-15); });
  EXPECT_EQ(verdict_on("momentum_consistency", doctored), ClaimVerdict::differs);
}

TEST(Claims, UnequalSolutionsDiffer) {
  for (const std::string& column : differences) {
    const ResultTables doctored = tables("equivalence", [&](Row& row) {
      if (is(row, "hamiltonian")) row.set(column, 1e-7);
    });
    EXPECT_EQ(verdict_on("equal_solutions", doctored), ClaimVerdict::differs) << column;
  }
}

TEST(Claims, ATangentSpaceDifferenceOfAnotherOrderDiffers) {
  const ResultTables doctored =
      tables("equivalence_slopes", [](Row& row) { row.set("slope", row.needed("stages") * 2.0 - 1.0); });
  EXPECT_EQ(verdict_on("tangent_differs", doctored), ClaimVerdict::differs);
}

TEST(Claims, AMissedOrderOfAnyQuantityAtTheNodesDiffers) {
  for (const char* quantity : {"state", "momentum", "costate", "control_from_costate"}) {
    for (const double wrong : {-1.0, 1.0}) {
      const ResultTables doctored = tables("convergence_indirect_slopes", [&](Row& row) {
        if (is(row, "hamiltonian") && row.text("quantity") == quantity && row.text("stages") == "3") {
          row.set("slope", row.needed("slope") + wrong);
        }
      });
      EXPECT_EQ(verdict_on("order_of_convergence", doctored), ClaimVerdict::differs) << quantity;
      EXPECT_EQ(verdict_on("order_of_adjoint_scheme", doctored),
                quantity == std::string("costate") ? ClaimVerdict::differs : ClaimVerdict::reproduced);
    }
  }
}

TEST(Claims, OrdersOfWhichNoneRisesAboveTheFloorAreNeitherReproducedNorRefuted) {
  const ResultTables floored = tables("convergence_indirect_slopes", [](Row& row) {
    row.set("verdict", "floor");
    row.set("slope", Cell());
  });
  EXPECT_EQ(verdict_on("order_of_convergence", floored), ClaimVerdict::floor);
}

TEST(Claims, AnOrderOfLowTableausThatFinerGridsContradictDoesNotHideBehindTheOthers) {
  for (const std::string quantity : {"state", "costate"}) {
    for (const char* const stages : {"2", "3"}) {
      const ResultTables doctored = tables("convergence_indirect_slopes", [&](Row& row) {
        if (row.text("tableau") != "lobatto" || row.text("stages") != stages || row.text("quantity") != quantity)
          return;
        row.set("slope", 1.0);
        row.set("fine_end", "orders");
      });
      EXPECT_EQ(verdict_on("order_of_convergence", doctored), ClaimVerdict::floor) << quantity << stages;
    }
  }
}

TEST(Claims, AnAdjointSchemeWithAResidualOrWithoutAControlDiffers) {
  const auto doctored = [](const char* column, double value) {
    return tables("equivalence", [=](Row& row) {
      if (row.number("adjoint_residual")) row.set(column, value);
    });
  };
  EXPECT_EQ(verdict_on("order_of_adjoint_scheme", doctored("adjoint_residual", 1e-6)), ClaimVerdict::differs);
  EXPECT_EQ(verdict_on("order_of_adjoint_scheme", doctored("adjoint_residual_by_plain_coefficients", 1e-12)),
            ClaimVerdict::differs);
}

TEST(Claims, AnotherRatioOfVariablesDiffers) {
  const ResultTables doctored = tables("convergence", [](Row& row) {
    if (is(row, "dmoc")) row.set("free_variables", row.needed("intervals") * 4.0);
  });
  EXPECT_EQ(verdict_on("variable_ratio", doctored), ClaimVerdict::differs);
}

TEST(Claims, AnotherRatioOfMinorIterationsDiffers) {
  for (const double factor : {0.9, 1.1}) {
    const ResultTables doctored = tables("iterations", [&](Row& row) {
      if (is(row, "dmoc")) row.set("minor_iterations", row.needed("minor_iterations") * factor);
    });
    EXPECT_EQ(verdict_on("minor_iteration_ratio", doctored), ClaimVerdict::differs) << factor;
    EXPECT_EQ(verdict_on("minor_iterations_equal_variable_ratio", doctored), ClaimVerdict::differs) << factor;
  }
}

TEST(Claims, TheSavingLiesNotInPhase1IfACrashBasisKeepsIt) {
  const ResultTables doctored = tables("iterations", [](Row& row) {
    if (row.text("crash") == "basis") row.set("minor_iterations", row.needed("free_variables") + 3.0);
  });
  EXPECT_EQ(verdict_on("minor_iterations_saved_in_phase_1", doctored), ClaimVerdict::differs);
}

TEST(Claims, RatiosOnBothSidesOfThePublishedRangeAreUndecided) {
  const auto of_collocation = [](double factor, const std::string& intervals) {
    return tables("iterations", [=](Row& row) {
      if (!is(row, "dmoc") && row.text("intervals") == intervals)
        row.set("minor_iterations", row.needed("minor_iterations") * factor);
    });
  };
  EXPECT_EQ(verdict_on("minor_iteration_ratio", of_collocation(0.8, "64")), ClaimVerdict::undecided);
  EXPECT_EQ(verdict_on("minor_iteration_ratio", of_collocation(0.8, "none")), ClaimVerdict::reproduced);
}

bool is_difference(const Row& row) { return row.text("derivatives").ends_with("differences"); }

/// The verdict where forward differences, or the tape, solve nothing, some or all.
ClaimVerdict robustness(const std::string& derivatives, const std::function<bool(const Row&)>& is_solved) {
  const ResultTables results = tests::results_of(tests::rows_of_tables(), [&](const std::string&, Row& row) {
    if (row.text("derivatives") == derivatives) row.set("status", is_solved(row) ? "solved" : "step failed");
  });
  return verdict_on("automatic_differentiation_more_robust", results);
}

TEST(Claims, RobustnessIsJudgedBySolvesOfTheSameProgram) {
  const auto all = [](const Row&) { return true; };
  const auto none = [](const Row&) { return false; };
  const auto one = [](const Row& row) { return is(row, "dmoc") && row.text("intervals") == "16"; };
  EXPECT_EQ(robustness("forward_differences", none), ClaimVerdict::reproduced);
  EXPECT_EQ(robustness("forward_differences", all), ClaimVerdict::undecided) << "as robust";
  EXPECT_EQ(robustness("dense_differences", all), ClaimVerdict::undecided) << "as robust";
  EXPECT_EQ(robustness("tape", one), ClaimVerdict::differs);
  EXPECT_EQ(robustness("adolc_whole", one), ClaimVerdict::differs);
  EXPECT_EQ(robustness("finite_differences", all), ClaimVerdict::reproduced)
      << "central differences are not the paper's";
}

TEST(Claims, TimesAreJudgedByWholeIntervals) {
  const auto verdict = [](const std::string& seconds) {
    return verdict_on("automatic_differentiation_saves_time", tables("derivatives_quasi_newton", [&](Row& row) {
                        if (is_difference(row)) row.set("round_seconds", seconds);
                      }));
  };
  EXPECT_EQ(verdict(tests::rounds_around(0.03)), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict(tests::rounds_around(0.005)), ClaimVerdict::differs);
  EXPECT_EQ(verdict(tests::rounds_around(0.01, 2.0)), ClaimVerdict::undecided);
  EXPECT_EQ(verdict("0.03 0.03 0.03"), ClaimVerdict::undecided) << "three rounds";
  EXPECT_EQ(verdict("0.03 soon 0.03"), ClaimVerdict::not_judged);
}

TEST(Claims, DifferencesThatSolveNothingAreNotSlower) {
  const ResultTables results = tests::results_of(tests::rows_of_tables(), [](const std::string&, Row& row) {
    if (is_difference(row)) row.set("status", "acceptable");
  });
  EXPECT_EQ(verdict_on("automatic_differentiation_saves_time", results), ClaimVerdict::not_judged);
}

TEST(Claims, AMissingFieldIsNotYetJudged) {
  const auto erase = [](const char* column) { return [column](Row& row) { row.set(column, Cell()); }; };
  EXPECT_EQ(verdict_on("momentum_consistency", tables("consistency", erase("momentum_defect_max"))),
            ClaimVerdict::not_judged);
  EXPECT_EQ(verdict_on("equal_solutions", tables("equivalence", erase("configuration_difference"))),
            ClaimVerdict::not_judged);
}

TEST(Claims, ASlipIsConfirmedByTheValueThatMustHold) {
  Row row;
  row.set("problem", orbit);
  row.set("misprint", "boundary_momenta");
  row.set("value_as_printed", 1.02);
  row.set("value_as_meant", 1.0);
  row.set("required_value", 1.0);
  const auto verdict = [&] { return verdict_on("boundary_momenta", tests::results_of({{"misprints", {row}}})); };
  EXPECT_EQ(verdict(), ClaimVerdict::differs);
  row.set("value_as_printed", 1.0);
  EXPECT_EQ(verdict(), ClaimVerdict::reproduced);
  row.set("value_as_printed", 1.02);
  row.set("value_as_meant", 1.01);
  EXPECT_EQ(verdict(), ClaimVerdict::undecided);
}

TEST(Claims, ASlipTellsTheRowThatItWasJudgedBy) {
  ResultTables results;
  results.add("misprints",
              Table::from_csv("problem,misprint,where,printed,meant,quantity,value_as_printed,value_as_meant,"
                              "required_value\norbit,first,,,,,2,1,1\norbit,second,,,,,3,1,1\n"));
  const std::vector<ReadRows> read = tests::judged_claim("orbit/second", results).rows;
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read.front().table, "misprints.csv");
  EXPECT_EQ(read.front().records, std::vector<std::size_t>{3});
  for (const char* const column : {"value_as_printed", "value_as_meant", "required_value"})
    EXPECT_EQ(std::ranges::count(read.front().columns, column), 1) << column;
}

TEST(Claims, OfOursHaveOneStatementThatHoldsOnSomeProblemsAndNotOnOthers) {
  std::map<std::string, std::string> statements;
  for (const JudgedClaim& claim : judge_claims(tables())) {
    if (claim.whose != Whose::ours) continue;
    EXPECT_EQ(statements.try_emplace(claim.name, claim.states).first->second, claim.states) << claim.id();
  }
  EXPECT_GT(statements.size(), 30U);
}

TEST(Claims, IdsAreUniqueAndBeginWithTheirProblem) {
  std::set<std::string> seen;
  for (const JudgedClaim& claim : judge_claims(tables())) {
    EXPECT_TRUE(seen.insert(claim.id()).second) << claim.id();
    EXPECT_TRUE(claim.id().starts_with("orbital_transfer/") || claim.id().starts_with("two_link_manipulator/") ||
                claim.id().starts_with("forced_oscillator/") || claim.id().starts_with("simulations/") ||
                claim.id().starts_with("examples/") || claim.id().starts_with("eccentric_transfer/") ||
                claim.id().starts_with("hypersensitive/") || claim.id().starts_with("constrained/") ||
                claim.id().starts_with("phases/") || claim.id().starts_with("rigid_body/") ||
                claim.id().starts_with("cart_pole/") || claim.id().starts_with("container_crane/"))
        << claim.id();
    EXPECT_FALSE(claim.states.empty());
    EXPECT_FALSE(claim.where.empty());
    EXPECT_FALSE(claim.evidence.empty()) << claim.id();
    for (const std::string& file : claim.evidence) EXPECT_EQ(file.find('{'), std::string::npos) << file;
  }
}

}  // namespace
}  // namespace dmocbench
