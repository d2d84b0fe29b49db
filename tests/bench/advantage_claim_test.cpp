// Whether collocation is dearer by its size or by the solver, judged on doctored ratios.

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

/// Ratios of operations on the finer of two grids; on the coarser one all are 2.
Claim judged(double banded, double by_intervals, double recombined) {
  Table table({"problem"});
  for (const char* way : {"banded", "intervals", "recombined"}) table.append(ratio(way, "operations", 64, 2.0));
  table.append(ratio("banded", "operations", 128, banded));
  table.append(ratio("intervals", "operations", 128, by_intervals));
  table.append(ratio("recombined", "operations", 128, recombined));
  table.append(ratio("recombined", "elimination_operations", 128, 1.0));
  table.append(ratio("", "seconds_per_iteration", 128, 1.9));
  ResultTables tables;
  tables.add("structure_advantage_ratios", table);
  return advantage_claim(tables, "orbital_transfer");
}

TEST(AdvantageClaim, HoldsIfCollocationCostsMoreInEveryWay) {
  EXPECT_EQ(judged(2.3, 1.3, 1.2).verdict, Verdict::reproduced);
}

TEST(AdvantageClaim, DiffersIfOneWayMakesItNoDearer) {
  const Claim claim = judged(2.3, 1.3, 1.05);
  EXPECT_EQ(claim.verdict, Verdict::differs);
  for (const char* part : {"N = 128", "banded 2.30", "intervals 1.30", "recombined 1.05", "alone 1.00", "ipopt 1.90"}) {
    EXPECT_NE(claim.measured.find(part), std::string::npos) << claim.measured;
  }
}

TEST(AdvantageClaim, IsNotJudgedWithoutTheRecombinedElimination) {
  EXPECT_EQ(advantage_claim({}, "orbital_transfer").verdict, Verdict::not_yet);
  Table table({"problem"});
  table.append(ratio("intervals", "operations", 128, 1.3));
  ResultTables tables;
  tables.add("structure_advantage_ratios", table);
  EXPECT_EQ(advantage_claim(tables, "orbital_transfer").verdict, Verdict::not_yet);
}

}  // namespace
}  // namespace dmocbench
