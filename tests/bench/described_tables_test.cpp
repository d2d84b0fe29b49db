#include "bench/run/described_tables.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/run/result_file.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

using tests::expect_error_naming;

class WrittenTables : public tests::InTemporaryFolder {
 protected:
  [[nodiscard]] nlohmann::json told_of(const std::string& content) const {
    write_file(folder() / "table.csv", content);
    return {{"tables", nlohmann::json::parse(describe_tables({folder() / "table.csv"}).dump())}};
  }
};

TEST(Checksum, IsTheOneOfZlib) {
  EXPECT_EQ(checksum_of(""), "00000000");
  EXPECT_EQ(checksum_of("123456789"), "cbf43926");  // the check value that catalogues of CRCs give for CRC-32
}

TEST_F(WrittenTables, AreKnownAgainAsTheyWereWritten) {
  const std::string content = "a,b\n1,2\n3,\"x,\ny\"\n";
  EXPECT_NO_THROW(require_as_written(told_of(content), "table.json", "table.csv", content));
  EXPECT_NO_THROW(require_as_written(told_of("a\n"), "table.json", "table.csv", "a\n"));
}

TEST_F(WrittenTables, AreRefusedWithWhatDisagrees) {
  const nlohmann::json told = told_of("a,b\n1,2\n3,4\n");
  const auto expect = [&](const std::string& content, std::initializer_list<std::string> words) {
    expect_error_naming(words, [&] { require_as_written(told, "table.json", "table.csv", content); });
  };
  expect("a,b\n1,2\n3,5\n", {"checksum", "table.json"});
  expect("a,b\n3,4\n1,2\n", {"checksum"});
  expect("a,b\n1,2\n", {"2 rows", "has 1"});
  expect("a,b,c\n1,2,0\n3,4,0\n", {"the column \"c\""});
  expect("a,c\n1,2\n3,4\n", {"the column \"c\""});
  expect("a\n1\n3\n", {"lacks the column \"b\""});
  expect("a,\xff\n1,2\n3,4\n", {"the column \"\xff\""});  // no UTF-8
}

TEST_F(WrittenTables, AreRefusedWhereTheMetadataTellNothingOfThem) {
  for (const char* const told : {"{}", "[]", "null", R"({"tables": 5})", R"({"tables": {"other.csv": {}}})",
                                 R"({"tables": {"table.csv": {"columns": "a", "rows": 0, "crc32": "0"}}})",
                                 R"({"tables": {"table.csv": {"columns": [5], "rows": 0, "crc32": "0"}}})",
                                 R"({"tables": {"table.csv": {"columns": ["a"], "rows": {}, "crc32": "0"}}})",
                                 R"({"tables": {"table.csv": {"columns": ["a"], "rows": 0, "crc32": 7}}})"}) {
    expect_error_naming({"table.json does not list table.csv"},
                        [&] { require_as_written(nlohmann::json::parse(told), "table.json", "table.csv", "a\n"); });
  }
}

TEST_F(WrittenTables, AreRegularTablesAlone) {
  write_file(folder() / "table.md", "| a |\n");
  std::filesystem::create_directory(folder() / "folder.csv");
  EXPECT_TRUE(describe_tables({folder() / "none.csv", folder() / "table.md", folder() / "folder.csv"}).empty());
}

}  // namespace
}  // namespace dmocbench
