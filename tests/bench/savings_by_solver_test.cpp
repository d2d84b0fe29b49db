// Which rows of the experiment savings_by_solver are compared.

#include <string>

#include <gtest/gtest.h>

#include "bench/tables/ratios.hpp"
#include "tests/bench/declared_tables.hpp"

namespace dmocbench {
namespace {

Row row_of(const std::string& method, const std::string& factorisation, int intervals, double seconds, double error) {
  Row row = tests::scheme_row(method);
  row.set("solver", "interior_point");
  row.set("factorisation", factorisation);
  row.set("intervals", static_cast<long long>(intervals));
  row.set("status", "solved");
  row.set("branch", "same");
  row.set("objective", 1.0 + error);
  row.set("objective_error", error);
  row.set("seconds", seconds);
  row.set("major_iterations", 10LL);
  return row;
}

/// The row of the ratios of a quantity; an empty one if there is none.
Row ratio_of(const Table& table, const std::string& factorisation, int intervals, const std::string& quantity) {
  for (const Row& row : table.rows()) {
    if (row.text("factorisation") == factorisation && row.text("quantity") == quantity &&
        row.text("intervals") == std::to_string(intervals)) {
      return row;
    }
  }
  return {};
}

TEST(AdvantageRatios, StandAtEqualGridsAndAtEqualErrors) {
  Table table({"problem"});
  table.append(row_of("dmoc", "intervals", 16, 1.0, 4e-4));
  table.append(row_of("dmoc", "intervals", 32, 2.0, 1e-4));
  table.append(row_of("hamiltonian", "intervals", 16, 3.0, 4e-4));
  table.append(row_of("hamiltonian", "intervals", 32, 2.5, 1e-4));
  table.append(row_of("tangent", "intervals", 16, 3.0, 1e-4));
  const Table ratios = advantage_ratios(table);
  EXPECT_EQ(ratio_of(ratios, "intervals", 32, "seconds").number("ratio_at_equal_intervals"), 1.25);
  EXPECT_EQ(ratio_of(ratios, "intervals", 32, "iterations").number("ratio_at_equal_accuracy"), 1.0);
  int of_tangent = 0;
  for (const Row& row : ratios.rows()) {
    if (row.text("method") != "tangent" || row.text("quantity") != "seconds") continue;
    ++of_tangent;
    EXPECT_EQ(row.number("ratio_at_equal_intervals"), 3.0);
    EXPECT_NEAR(row.number("ratio_at_equal_accuracy").value_or(0.0), 1.5, 1e-12);
  }
  EXPECT_EQ(of_tangent, 1);
}

TEST(AdvantageRatios, LeaveOutWhatIsNotSolvedOrNotTheSameAnswer) {
  Table table({"problem"});
  table.append(row_of("dmoc", "intervals", 16, 1.0, 4e-4));
  table.append(row_of("hamiltonian", "intervals", 16, 3.0, 4e-4));
  Row failed = row_of("hamiltonian", "sparse", 16, 1.0, 4e-4);
  failed.set("status", "iteration limit");
  table.append(failed);
  Row elsewhere = row_of("hamiltonian", "other", 16, 1.0, 4e-4);
  elsewhere.set("objective", 1.5);
  table.append(elsewhere);
  table.append(row_of("dmoc", "other", 16, 1.0, 4e-4));
  table.append(row_of("dmoc", "sparse", 16, 1.0, 4e-4));
  const Table ratios = advantage_ratios(table);
  EXPECT_FALSE(ratio_of(ratios, "intervals", 16, "seconds").text("method").empty());
  EXPECT_TRUE(ratio_of(ratios, "sparse", 16, "seconds").text("method").empty());
  EXPECT_TRUE(ratio_of(ratios, "other", 16, "seconds").text("method").empty());
}

}  // namespace
}  // namespace dmocbench
