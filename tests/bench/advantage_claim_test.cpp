// Whether collocation is dearer by its size or by the solver, judged on doctored ratios.

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "bench/claims/claim.hpp"
#include "tests/bench/declared_tables.hpp"

namespace dmocbench {
namespace {

Row ratio(const std::string& factorisation, const std::string& quantity, int intervals, double value) {
  Row row = tests::scheme_row("hamiltonian");
  row.set("solver", factorisation.empty() ? "ipopt" : "interior_point");
  row.set("factorisation", factorisation);
  row.set("intervals", static_cast<long long>(intervals));
  row.set("quantity", quantity);
  std::vector<double> rounds(11);
  for (std::size_t i = 0; i < rounds.size(); ++i)
    rounds[i] = value * (1.0 + 0.02 * std::sin(5.0 * static_cast<double>(i)));
  row.set("round_ratios", joined_numbers(rounds));
  return row;
}

/// What is said of the orbit.
JudgedClaim judged(const std::string& claim, const tests::Rows& rows) {
  return tests::judged_claim("orbital_transfer/" + claim, tests::results_of({{"savings_by_solver_ratios", rows}}));
}

TEST(ExpenseClaim, IsJudgedByTheTimesOfEverySolver) {
  const auto verdict = [](double ipopt, double sparse) {
    return judged("collocation_takes_longer", {ratio("", "seconds_per_iteration", 128, ipopt),
                                               ratio("intervals", "seconds_per_linear_system", 128, 1.3),
                                               ratio("sparse", "seconds_per_linear_system", 128, sparse)})
        .verdict;
  };
  EXPECT_EQ(verdict(1.9, 1.2), ClaimVerdict::reproduced);
  EXPECT_EQ(verdict(1.9, 0.95), ClaimVerdict::differs);
  EXPECT_EQ(verdict(1.9, 1.0), ClaimVerdict::undecided);
  EXPECT_EQ(verdict(0.9, 1.2), ClaimVerdict::differs);
  EXPECT_EQ(judged("collocation_takes_longer", {}).verdict, ClaimVerdict::not_judged);
}

TEST(ExpenseClaim, TakesTheCoarseGridsTogether) {
  const auto verdict = [](double coarsest, double coarse, double finest) {
    return judged("collocation_more_expensive_on_coarse_grids",
                  {ratio("", "seconds_per_iteration", 32, 1.5), ratio("", "seconds_per_iteration", 128, 1.5),
                   ratio("intervals", "seconds_per_linear_system", 32, coarsest),
                   ratio("intervals", "seconds_per_linear_system", 64, coarse),
                   ratio("intervals", "seconds_per_linear_system", 128, finest)});
  };
  const JudgedClaim claim = verdict(0.98, 1.47, 0.8);
  EXPECT_EQ(claim.verdict, ClaimVerdict::reproduced);
  EXPECT_NE(claim.measured().find("intervals N = 32 and 64 1.2"), std::string::npos) << claim.measured();
  EXPECT_EQ(verdict(0.8, 1.1, 2.0).verdict, ClaimVerdict::differs);
  EXPECT_EQ(verdict(0.9, 1.11, 2.0).verdict, ClaimVerdict::undecided);
}

}  // namespace
}  // namespace dmocbench
