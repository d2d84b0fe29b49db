#include <gtest/gtest.h>

#include "bench/tables/profile_tables.hpp"
#include "tests/bench/declared_tables.hpp"

namespace dmocbench {
namespace {

Row row_of_library(const char* problem, const char* method, long long intervals, double objective,
                   const char* status = "solved") {
  Row row = tests::scheme_row(method, problem, 2);
  row.set("solver", "ipopt");
  row.set("derivatives", "tape");
  row.set("intervals", intervals);
  row.set("status", status);
  row.set("objective", objective);
  row.set("success", objective < -4.0 ? "yes" : "no");
  row.set("message", "a sentence");
  if (std::string(problem) == "known") {
    row.set("reference_objective", -4.0);
    row.set("reference_digits", 13LL);
  }
  return row;
}

Table library_rows() {
  Table rows({"problem"});
  rows.append(row_of_library("known", "dmoc", 128, -4.04));
  rows.append(row_of_library("known", "dmoc", 32, -5.0));
  rows.append(row_of_library("known", "tangent", 32, -3.0));
  rows.append(row_of_library("known", "tangent", 128, -3.0, "iteration limit"));
  rows.append(row_of_library("unknown", "dmoc", 64, 2.0));  // its finest grid is another
  rows.append(row_of_library("easy", "dmoc", 64, -5.0));
  rows.append(row_of_library("easy", "tangent", 64, -5.0));
  return rows;
}

TEST(LibraryTable, HoldsTheFinestGridOfEveryCurveFailedOnesToo) {
  const Table library = library_table(library_rows());
  ASSERT_EQ(library.rows().size(), 5U);
  const auto expect = [&](std::size_t i, const char* method, double intervals, const char* status) {
    EXPECT_EQ(library.rows()[i].text("method"), method);
    EXPECT_EQ(library.rows()[i].number("intervals"), intervals);
    EXPECT_EQ(library.rows()[i].text("status"), status);
    EXPECT_EQ(library.rows()[i].text("message"), "a sentence");
  };
  expect(0, "dmoc", 128.0, "solved");
  expect(1, "tangent", 128.0, "iteration limit");
  expect(2, "dmoc", 64.0, "solved");
  EXPECT_NEAR(library.rows()[0].number("relative_difference").value_or(0.0), -0.01, 1e-15);  // lower than the reference
  EXPECT_NEAR(library.rows()[1].number("relative_difference").value_or(0.0), 0.25, 1e-15);
  EXPECT_FALSE(library.rows()[2].number("relative_difference"));
  EXPECT_EQ(Table::from_csv(library.csv()).rows().size(), 5U);
}

TEST(LibraryTable, ProblemsWithoutAReferenceAreMeasuredByTheBestFoundOnTheFinestGrid) {
  Table rows(
      {"problem", "method", "intervals", "status", "objective", "success", "reference_objective", "reference_kind"});
  rows.append(row_of_library("known", "dmoc", 128, -4.04));
  rows.append(row_of_library("unknown", "dmoc", 32, 1.5));  // lower, but a coarse grid's
  rows.append(row_of_library("unknown", "dmoc", 64, 2.0));
  rows.append(row_of_library("unknown", "tangent", 64, 2.01));
  rows.append(row_of_library("unknown", "hamiltonian", 64, 1.0, "too coarse"));
  rows.append(row_of_library("unsolved", "dmoc", 64, 1.0, "infeasible"));
  const Table filled = with_best_found_references(rows, 0.02);
  EXPECT_EQ(filled.rows()[0].number("reference_objective"), -4.0);
  EXPECT_EQ(filled.rows()[0].text("reference_kind"), "");
  const auto expect = [&](std::size_t i, const char* success) {
    EXPECT_EQ(filled.rows()[i].number("reference_objective"), 2.0) << i;
    EXPECT_EQ(filled.rows()[i].text("reference_kind"), "best found by any method here") << i;
    EXPECT_EQ(filled.rows()[i].text("success"), success) << i;
  };
  expect(1, "no");
  expect(2, "yes");
  expect(3, "yes");
  expect(4, "no");
  EXPECT_FALSE(filled.rows()[5].number("reference_objective"));
  const std::string text = library_table_in_markdown(library_table(filled));
  EXPECT_NE(text.find("| unknown | 64 | 2 (best found by any method here) |"), std::string::npos) << text;
}

TEST(LibraryTable, ReadsAsMarkdownWithALinePerProblemAndAColumnPerMethod) {
  const std::string text = library_table_in_markdown(library_table(library_rows()));
  for (const char* line :
       {"\n## gauss 2, ipopt, tape\n", "\n| problem | N | reference | dmoc | tangent |\n|---|---|---|---|---|\n",
        "\n| known | 128 | -4 (13 digits) | -4.04 (-1.0e-02) | iteration limit |\n",
        "\nSolved with all methods: 1 of 3 problems; successful with all methods: 1.\n",
        "\n| unknown | 64 | unknown | 2 elsewhere |  |\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "is not in\n" << text;
  }
}

}  // namespace
}  // namespace dmocbench
