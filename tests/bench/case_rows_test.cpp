#include "bench/run/case_rows.hpp"

#include <gtest/gtest.h>

#include "tests/support/sentence_of_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

using Json = nlohmann::ordered_json;

class Rows : public tests::InTemporaryFolder {
 protected:
  [[nodiscard]] CaseRows rows(const std::string& file) {
    return {experiment_, 3, {"status", "objective"}, RowStore(folder() / file, {{"identity", "x"}})};
  }
  void keep_in(const std::string& file, std::size_t number, double cost) {
    Row row;
    row.set("status", "solved");
    row.set("objective", cost);
    CaseRows kept = rows(file);
    kept.resume({0, 1, 2});
    kept.keep(number, row);
  }

  Experiment experiment_{ExperimentCard{.name = "objective", .description = "", .options = {}}};
};

TEST_F(Rows, OfAnInterruptedRunAreTakenOverInWholeGroups) {
  keep_in("a.rows", 2, 0.5);
  keep_in("a.rows", 0, 1.5);
  CaseRows all = rows("a.rows");
  EXPECT_EQ(all.resume({0, 1, 2}), 2U);
  EXPECT_EQ(all.table().csv(), "status,objective\nsolved,1.5\nsolved,0.5\n");
  CaseRows grouped = rows("a.rows");
  EXPECT_EQ(grouped.resume({0, 0, 2}), 1U) << "the first case depends on the second one, which has no row";
  EXPECT_FALSE(grouped.contain(0));
}

TEST_F(Rows, OfAnotherProcessAreCollectedOnce) {
  keep_in("child.rows", 1, 0.5);
  CaseRows parent = rows("a.rows");
  EXPECT_EQ(parent.collect(folder() / "child.rows"), std::vector<std::size_t>{1});
  EXPECT_TRUE(parent.collect(folder() / "child.rows").empty());
  EXPECT_EQ(rows("a.rows").resume({0, 1, 2}), 1U);
}

TEST_F(Rows, ThatNoRunWritesAreRefused) {
  for (const char* const entry :
       {R"({"case":4,"row":["solved","1"]})", R"({"case":0,"row":["solved","1"]})",
        R"({"case":"2","row":["solved","1"]})", R"({"case":2,"row":["solved"]})", R"({"case":2,"row":["solved",1]})",
        R"({"case":2,"row":["solved","nan"]})", R"({"case":2,"row":["solved",""]})", R"({"case":2})"}) {
    RowStore(folder() / "a.rows", {{"identity", "x"}}).append(Json::parse(entry));
    tests::expect_error_naming({"a.rows"}, [&] { rows("a.rows").resume({0, 1, 2}); });
  }
}

TEST(PartNumbers, AreNamedByRanges) {
  EXPECT_EQ(in_ranges({3}), "3");
  EXPECT_EQ(in_ranges({1, 2, 4, 6, 7, 8}), "1 and 2, 4, 6 to 8");
}

}  // namespace
}  // namespace dmocbench
