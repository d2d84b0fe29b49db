#include <gtest/gtest.h>

#include "bench/summary/profile_tables.hpp"

namespace dmocbench {
namespace {

Row row_of_library(const char* problem, const char* method, long long intervals, double objective,
                   const char* status = "solved") {
  Row row;
  row.set("problem", problem);
  row.set("method", method);
  row.set("tableau", "gauss");
  row.set("stages", 2LL);
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

TEST(LibraryTable, ReadsAsMarkdownWithALinePerProblemAndAColumnPerMethod) {
  const std::string text = library_table_in_markdown(library_table(library_rows()));
  for (const char* line :
       {"\n## gauss 2, ipopt, tape\n", "\n| problem | N | reference | dmoc | tangent |\n|---|---|---|---|---|\n",
        "\n| known | 128 | -4 (13 digits) | -4.04 (-1.0e-02) | iteration limit |\n",
        "\nSolved by all: 1 of 3 problems; with success by all: 1.\n",
        "\n| unknown | 64 | unknown | 2 elsewhere |  |\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "is not in\n" << text;
  }
}

}  // namespace
}  // namespace dmocbench
