#include "bench/tables/selection.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

Row solve(const char* method, long long intervals, const std::optional<double>& error, const char* branch = "same") {
  Row row;
  row.set("method", method);
  row.set("intervals", intervals);
  row.set("status", "solved");
  row.set("branch", branch);
  row.set("error", error);
  return row;
}

class Selections : public testing::Test {
 protected:
  Selections() {
    for (const Row& row : {solve("tangent", 16, 4.0), solve("dmoc", 16, 2.0), solve("tangent", 32, 1.0, "other"),
                           solve("dmoc", 32, 0.5), solve("dmoc", 64, std::nullopt)}) {
      table_.append(row);
    }
  }
  Table table_{{"method", "intervals", "status", "branch", "error"}};
};

std::string grids(const Selection& rows) {
  return rows.in_words(" ", [](const Row& row) { return row.text("method") + row.text("intervals"); });
}

TEST_F(Selections, KeepTheOrderOfTheTable) {
  const Selection all(table_);
  EXPECT_EQ(all.size(), 5U);
  EXPECT_EQ(grids(all.where("method", "dmoc")), "dmoc16 dmoc32 dmoc64");
  EXPECT_EQ(grids(all.where([](const Row& row) { return row.number("intervals", 0.0) > 16.0; }).usable()),
            "dmoc32 dmoc64");
  EXPECT_FALSE(all.are_usable());
  EXPECT_TRUE(all.where("intervals", "16").are_usable());
}

TEST_F(Selections, OfNothingHaveAnEmptyRowInFrontAndBehind) {
  const Selection none = Selection(table_).where("method", "hamiltonian");
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.front().text("method"), "");
  EXPECT_FALSE(none.back().number("error"));
  EXPECT_EQ(none.max("error"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(none.group_by({"method"}).empty());
}

TEST_F(Selections, AreGroupedInTheOrderOfTheirFirstRows) {
  const std::vector<Selection> methods = Selection(table_).group_by({"method"});
  ASSERT_EQ(methods.size(), 2U);
  EXPECT_EQ(grids(methods[0]), "tangent16 tangent32");
  EXPECT_EQ(grids(methods[1]), "dmoc16 dmoc32 dmoc64");
  EXPECT_EQ(Selection(table_).group_by({"method", "branch"}).size(), 3U);
  EXPECT_EQ(Selection(table_).distinct("intervals"), (std::vector<std::string>{"16", "32", "64"}));
}

TEST_F(Selections, AreJoinedByEqualFields) {
  const Selection dmoc = Selection(table_).where("method", "dmoc");
  const Selection tangent = Selection(table_).where("method", "tangent");
  EXPECT_EQ(grids(dmoc.matching(tangent.back(), {"intervals"})), "dmoc32");
  EXPECT_EQ(grids(dmoc.matching(tangent.back(), {"intervals", "branch"})), "");
  EXPECT_EQ(ratio(tangent.front().number("error"), dmoc.front().number("error")), 2.0);
  EXPECT_FALSE(ratio(tangent.front().number("error"), dmoc.back().number("error")));
  EXPECT_FALSE(ratio(1.0, 0.0));
}

TEST_F(Selections, OfAMissingNumberHaveNeitherALargestNorASmallest) {
  const Selection all(table_);
  EXPECT_EQ(all.where("intervals", "16").max("error"), 4.0);
  EXPECT_EQ(all.where("intervals", "16").min("error"), 2.0);
  tests::expect_error_naming({"error", "no number"}, [&] { static_cast<void>(all.max("error")); });
  tests::expect_error_naming({"error", "no number"}, [&] { static_cast<void>(all.min("error")); });
}

TEST_F(Selections, AreSortedByNumbersAndNotByTexts) {
  table_.append(solve("dmoc", 128, 3.0));
  const Selection all(table_);
  EXPECT_EQ(grids(all.where("method", "dmoc").sorted_by("intervals")), "dmoc16 dmoc32 dmoc64 dmoc128");
  EXPECT_EQ(grids(all.sorted_by("error")), "dmoc32 tangent32 dmoc16 dmoc128 tangent16");
}

TEST_F(Selections, GiveTheFieldsOfSomeColumnsToOtherRows) {
  const Row fields = fields_of(table_.rows().front(), {"method", "error"});
  EXPECT_EQ(fields.text("method"), "tangent");
  EXPECT_EQ(fields.number("error"), 4.0);
  EXPECT_EQ(fields.text("intervals"), "");
}

}  // namespace
}  // namespace dmocbench
