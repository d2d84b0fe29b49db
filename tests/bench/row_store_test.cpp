#include "bench/run/row_store.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/run/result_file.hpp"
#include "bench/run/table_run.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

using Json = nlohmann::ordered_json;
using tests::expect_error_naming;

const Json header{{"identity", {{"--tolerance", "1e-8"}}}};
const Json first{{"case", 1}, {"row", {"a, \"b\"\nc", ""}}};
const Json second{{"case", 2}};

class Stores : public tests::InTemporaryFolder {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder() / "invariants.rows"; }
  void write_two() const {
    RowStore store(file(), header);
    for (const Json& entry : {first, second}) store.append(entry);
  }
  [[nodiscard]] std::vector<Json> entries() const { return read_store(file()).entries; }
};

TEST_F(Stores, HaveALineOfJsonWithItsChecksumForTheHeaderAndEachEntry) {
  write_two();
  EXPECT_EQ(read_store(file()).header, header);
  EXPECT_EQ(entries(), (std::vector{first, second}));
  const std::string content = read_file(file());
  EXPECT_EQ(std::ranges::count(content, '\n'), 3);
  EXPECT_TRUE(content.ends_with(fmt::format("\n{{\"crc32\":\"{}\",\"case\":2}}\n", checksum_of("\"case\":2}"))));
  expect_error_naming({"cannot write", "/dev/full"}, [] { RowStore("/dev/full", header).append(first); });
}

TEST_F(Stores, LoseNothingButATornOrDamagedLastLine) {
  write_two();
  const std::string whole = read_file(file());
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const auto lines = static_cast<std::size_t>(std::ranges::count(whole.substr(0, i), '\n'));
    write_file(file(), whole.substr(0, i));
    EXPECT_EQ(entries().size(), lines == 0 ? 0 : lines - 1) << "torn after " << i << " bytes";
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    write_file(file(), damaged);
    if (i + 1 < last) {
      expect_error_naming({"invariants.rows", "damaged"}, [&] { static_cast<void>(entries()); });
    } else {
      EXPECT_EQ(entries().size(), i < last ? 0U : 1U) << "the last line break joins two lines";
    }
  }
}

TEST_F(Stores, GoOnWithTheEntriesOfTheSameRunThatAreKept) {
  write_two();
  write_file(file(), read_file(file()) + "{\"crc32\":\"torn");
  EXPECT_TRUE(RowStore(file(), {{"identity", "other"}}).resume().empty());
  RowStore resumed(file(), header);
  EXPECT_EQ(resumed.resume(), (std::vector{first, second}));
  resumed.keep(second);
  EXPECT_EQ(entries().size(), 2U) << "the file changes before there is a new entry";
  for (const int number : {3, 4}) resumed.append({{"case", number}});
  EXPECT_EQ(entries(), (std::vector<Json>{second, {{"case", 3}}, {{"case", 4}}}));
  resumed.remove();
  EXPECT_TRUE(RowStore(file(), header).resume().empty());
}

TEST_F(Stores, OfACopiedFolderHaveTheirTablesThere) {
  TableFile table{.file = folder() / "invariants_orders.csv", .table = Table::from_csv("problem,order\narm,2\n")};
  table.table.describe({{"order", {"h", "of the error", {FieldKind::number, true}}}});
  const Json entry = Json::parse(entry_of_stage("one", {table}).dump());  // as a file has it
  const auto tables = tables_of_stage(entry, folder() / "copy" / "invariants.rows");
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables.front().file, folder() / "copy" / "invariants_orders.csv");
  EXPECT_EQ(tables.front().table.csv(), "problem,order\narm,2\n");
  EXPECT_EQ(tables.front().table.facts().at("order").type.kind, FieldKind::number);
  const auto expect_refused = [&](const char* const member, const Json& value, const std::string& words) {
    Json changed = entry;
    changed["tables"][0][member] = value;
    expect_error_naming({"invariants.rows", words}, [&] { static_cast<void>(tables_of_stage(changed, file())); });
  };
  for (const char* const name :
       {"/tmp/victim", "../invariants", "invariants/../../victim", ".bashrc", "convergence", ""})
    expect_refused("name", name, "which this run does not write");
  for (const char* const member : {"name", "csv", "facts", "key", "not_measured"})
    expect_refused(member, nullptr, member);
}

}  // namespace
}  // namespace dmocbench
