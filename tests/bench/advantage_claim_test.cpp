// Whether collocation is dearer by its size or by the solver, judged on doctored ratios.

#include <initializer_list>
#include <string>

#include <gtest/gtest.h>

#include "bench/claims/predicates.hpp"

namespace dmocbench {
namespace {

Row ratio(const std::string& factorisation, const std::string& quantity, int intervals, double value) {
  Row row;
  row.set("problem", "orbital_transfer");
  row.set("method", "hamiltonian");
  row.set("tableau", "gauss");
  row.set("stages", 1LL);
  row.set("solver", factorisation.empty() ? "ipopt" : "interior_point");
  row.set("factorisation", factorisation);
  row.set("intervals", static_cast<long long>(intervals));
  row.set("quantity", quantity);
  row.set("ratio_at_equal_intervals", value);
  return row;
}

ResultTables tables_of(std::initializer_list<Row> rows) {
  Table table({"problem"});
  for (const Row& row : rows) table.append(row);
  ResultTables tables;
  tables.add("structure_advantage_ratios", table);
  return tables;
}

/// On the finer of two grids; on the coarser one all are 2.
Claim judged_factorisation(double banded, double by_intervals, double recombined) {
  const char* const quantity = "elimination_operations";
  return factorisation_claim(
      tables_of({ratio("banded", quantity, 64, 2.0), ratio("recombined", quantity, 64, 2.0),
                 ratio("banded", quantity, 128, banded), ratio("intervals", quantity, 128, by_intervals),
                 ratio("recombined", quantity, 128, recombined), ratio("recombined", "operations", 128, 1.09)}),
      "orbital_transfer");
}

TEST(FactorisationClaim, HoldsIfItTakesMoreOperationsInEveryWay) {
  EXPECT_EQ(judged_factorisation(2.3, 1.3, 1.2).verdict, ClaimVerdict::reproduced);
}

TEST(FactorisationClaim, DiffersIfOneWayTakesNoMore) {
  const Claim claim = judged_factorisation(2.3, 1.3, 1.0);
  EXPECT_EQ(claim.verdict, ClaimVerdict::differs);
  for (const char* part : {"N = 128", "banded 2.30", "intervals 1.30", "recombined 1.00", "1.09 with"}) {
    EXPECT_NE(claim.measured.find(part), std::string::npos) << claim.measured;
  }
}

TEST(FactorisationClaim, IsNotJudgedWithoutTheRecombinedElimination) {
  EXPECT_EQ(factorisation_claim({}, "orbital_transfer").verdict, ClaimVerdict::not_yet);
  EXPECT_EQ(factorisation_claim(tables_of({ratio("intervals", "elimination_operations", 128, 1.3)}), "orbital_transfer")
                .verdict,
            ClaimVerdict::not_yet);
}

TEST(ExpenseClaim, IsJudgedByTheTimesOfEverySolver) {
  const auto judged = [](double ipopt, double recombined) {
    return expense_claim(tables_of({ratio("", "seconds_per_iteration", 128, ipopt),
                                    ratio("intervals", "seconds_per_linear_system", 128, 1.3),
                                    ratio("recombined", "seconds_per_linear_system", 128, recombined)}),
                         "orbital_transfer")
        .verdict;
  };
  EXPECT_EQ(judged(1.9, 1.2), ClaimVerdict::reproduced);
  EXPECT_EQ(judged(1.9, 1.0), ClaimVerdict::differs);
  EXPECT_EQ(judged(0.9, 1.2), ClaimVerdict::differs);
  EXPECT_EQ(expense_claim({}, "orbital_transfer").verdict, ClaimVerdict::not_yet);
}

}  // namespace
}  // namespace dmocbench
