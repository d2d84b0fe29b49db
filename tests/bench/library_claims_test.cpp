// Claims about minima and about the whole library, on doctored tables.
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "bench/claims/claim.hpp"
#include "tests/bench/declared_tables.hpp"

namespace dmocbench {
namespace {

/// The minima of both of the paper's problems: on the two-link a second one that tangent-space collocation finds too,
/// or not.
ResultTables minima_of(double second_by_tangent, const char* is_motion = "yes", double solved = 60.0) {
  tests::Rows minima;
  tests::Rows shares;
  for (const char* problem : {orbit, two_link}) {
    for (const auto& [objective, dmoc, tangent] :
         {std::tuple(80.0, 3.0, 2.0), std::tuple(90.0, 4.0, second_by_tangent), std::tuple(100.0, 1.0, 0.0)}) {
      if (problem == orbit && objective > 80.0) continue;
      Row row;
      row.set("problem", problem);
      row.set("minimum", objective);
      row.set("objective", objective);
      row.set("dmoc", dmoc);
      row.set("hamiltonian", 0LL);
      row.set("tangent", tangent);
      row.set("is_motion", objective > 80.0 ? is_motion : "yes");
      minima.push_back(row);
    }
    for (const char* method : {"dmoc", "tangent"}) {
      Row row;
      row.set("problem", problem);
      row.set("method", method);
      row.set("solved", solved);
      shares.push_back(row);
    }
  }
  return tests::results_of({{"local_minima_minima", minima}, {"local_minima_shares", shares}});
}

TEST(LibraryClaims, DifferentGuessesLeadToDifferentSolutionsIfOneProblemHasTwoThatMoreThanOneMethodFinds) {
  const auto verdict = [](const ResultTables& tables) {
    return tests::judged_claim("examples/local_minima", tables).verdict;
  };
  EXPECT_EQ(verdict(minima_of(1.0)), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict(minima_of(0.0)), ClaimVerdict::differs);
  EXPECT_EQ(verdict(minima_of(1.0, "no")), ClaimVerdict::differs) << "artefacts of the grid are no minima";
  EXPECT_EQ(verdict(minima_of(0.0, "yes", 20.0)), ClaimVerdict::not_judged) << "too few starts to rule a share out";
}

/// The row of a successful solve.
Row solve(const std::string& problem, const char* method, const char* solver, double evaluations) {
  Row row;
  row.set("problem", problem);
  row.set("intervals", 32LL);
  row.set("method", method);
  row.set("solver", solver);
  row.set("success", "yes");
  row.set("objective", 1.0);
  row.set("evaluations", evaluations);
  return row;
}

/// The claim on a library where DMOC and Hamiltonian collocation win so many instances each by Ipopt, and another
/// solver counts a tenth; there DMOC wins one instance less.
JudgedClaim judged_library(int dmoc_wins, int hamiltonian_wins) {
  tests::Rows profile;
  for (int i = 0; i < dmoc_wins + hamiltonian_wins; ++i) {
    const bool dmoc_is_better = i < dmoc_wins;
    const bool is_better_by_other_solver = i + 1 < dmoc_wins;
    const std::string problem = "problem " + std::to_string(i);
    profile.push_back(solve(problem, "dmoc", "ipopt", dmoc_is_better ? 10.0 : 20.0));
    profile.push_back(solve(problem, "hamiltonian", "ipopt", 15.0));
    profile.push_back(solve(problem, "dmoc", "interior_point", is_better_by_other_solver ? 1.0 : 2.0));
    profile.push_back(solve(problem, "hamiltonian", "interior_point", 1.5));
  }
  return tests::judged_claim("library/dmoc_best_by_evaluations", tests::results_of({{"profile", profile}}));
}

TEST(LibraryClaims, TheLibraryIsJudgedByWhoIsBestMostOftenBySolver) {
  EXPECT_EQ(judged_library(5, 2).verdict, ClaimVerdict::reproduced);
  EXPECT_EQ(judged_library(4, 4).verdict, ClaimVerdict::differs);
  // By Ipopt DMOC is ahead, by the other solver it is not.
  EXPECT_EQ(judged_library(4, 3).verdict, ClaimVerdict::differs);
}

TEST(LibraryClaims, MethodsAreComparedWithinOneSolverWhateverItCounts) {
  const std::string measured = judged_library(5, 2).measured();
  for (const char* part : {"ipopt, 7 instances: dmoc   is best on 5, solves 7", "hamiltonian   is best on 2",
                           "interior_point, 7 instances: dmoc   is best on 4, solves 7"}) {
    EXPECT_NE(measured.find(part), std::string::npos) << part << " is not in " << measured;
  }
}

TEST(LibraryClaims, ALibraryThatWasNotSweptIsNotInTheTable) {
  for (const JudgedClaim& judged : judge_claims({})) EXPECT_FALSE(judged.id().starts_with("library/")) << judged.id();
}

}  // namespace
}  // namespace dmocbench
