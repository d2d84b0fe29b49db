#include "bench/run/finished_stages.hpp"

#include <filesystem>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/run/json_place.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/written_tables.hpp"
#include "methods/tables/table_file.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

using Json = nlohmann::ordered_json;
using Stages = tests::InTemporaryFolder;

const Json identity{{"options", "--quick"}};

/// A file of one finished stage with one table.
std::filesystem::path saved_in(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "structure.unfinished";
  FinishedStages stages(file, identity);
  stages.add("first", {{.file = folder / "structure_orders.csv", .table = Table::from_csv("problem,order\narm,2\n")}});
  return file;
}

/// Changes the content of such a file, whose checksum is right afterwards.
void doctor(const std::filesystem::path& file, const std::function<void(Json&)>& change) {
  Json saved = json_in(read_file(file), file.string());
  change(saved["content"]);
  saved["crc32"] = fmt::format("{:08x}", crc_32(saved["content"].dump()));
  write_file(file, saved.dump());
}

TEST_F(Stages, OfACopiedFolderHaveTheirTablesThere) {
  saved_in(folder());
  const std::filesystem::path copy = folder() / "copy";
  std::filesystem::create_directory(copy);
  std::filesystem::copy(folder() / "structure.unfinished", copy);
  FinishedStages stages(copy / "structure.unfinished", identity);
  const auto tables = stages.resume();
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables.front().file, copy / "structure_orders.csv");
  EXPECT_EQ(tables.front().table.csv(), "problem,order\narm,2\n");
  EXPECT_TRUE(stages.contain("first"));
}

TEST_F(Stages, NameTablesOfTheirRunWithoutAFolder) {
  for (const char* const name :
       {"/tmp/victim", "../structure", "structure/../../victim", ".bashrc", "convergence", ""}) {
    const auto file = saved_in(folder());
    doctor(file, [name](Json& content) { content["tables"][0]["name"] = name; });
    FinishedStages stages(file, identity);
    tests::expect_error_naming({"structure.unfinished", "not one of this run"},
                               [&] { static_cast<void>(stages.resume()); });
    EXPECT_EQ(stages.count(), 0U);
  }
}

TEST_F(Stages, OfWrongTypesAreNamed) {
  for (const char* const member : {"name", "csv", "meanings", "types", "key", "not_measured"}) {
    const auto file = saved_in(folder());
    doctor(file, [member](Json& content) { content["tables"][0][member] = nullptr; });
    FinishedStages stages(file, identity);
    tests::expect_error_naming({"structure.unfinished", member}, [&] { static_cast<void>(stages.resume()); });
  }
}

TEST_F(Stages, OfAnotherRunOrInDamagedFilesAreNotTakenOver) {
  constexpr std::size_t deep = 200000;
  const std::string nested = std::string(deep, '[') + std::string(deep, ']');
  const auto file = saved_in(folder());
  EXPECT_TRUE(FinishedStages(file, {{"options", "--all"}}).resume().empty());
  for (const std::string& content :
       {std::string(), std::string("{"), std::string("[]"), nested, R"({"content":)" + nested + R"(,"crc32":"x"})"}) {
    write_file(file, content);
    EXPECT_TRUE(FinishedStages(file, identity).resume().empty());
  }
  saved_in(folder());
  doctor(file, [](Json& content) { content.erase("identity"); });
  EXPECT_TRUE(FinishedStages(file, identity).resume().empty());
}

}  // namespace
}  // namespace dmocbench
