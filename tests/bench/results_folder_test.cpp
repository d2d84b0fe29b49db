#include "bench/report/results_folder.hpp"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/report/comparison_page.hpp"
#include "bench/report/page.hpp"
#include "bench/run/result_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* one_solve = "problem,method,status,intervals,objective\narm,dmoc,solved,16,0.125\n";

bool is_in_page(const std::string& page, const std::string& part) { return page.find(part) != std::string::npos; }

using ReportOnDisk = tests::InTemporaryFolder;

TEST_F(ReportOnDisk, StandsWhateverTypesMetadataHave) {
  write_file(folder() / "objective.csv", one_solve);
  const Json whole{{"command_line", {"objective", "--out", "x"}},
                   {"utc_time", "2026-01-01T00:00:00Z"},
                   {"wall_seconds", 1.5},
                   {"commit", "a"},
                   {"complete", true},
                   {"rows", 2},
                   {"not_solved", 1},
                   {"cost_scale", {{"arm", 1.0}}},
                   {"motions", {{{"nodes", "motion_arm_nodes.csv"}, {"problem", "arm"}, {"method", "dmoc"}}}},
                   {"tables",
                    {{"objective.csv",
                      {{"columns", {"problem"}},
                       {"meanings", {{"problem", "its name"}}},
                       {"schema", {{"primaryKey", {"problem"}}}}}}}}};
  std::vector<std::string> places;  // of everything, the whole apart
  const Json flat = whole.flatten();
  for (const auto& [place, value] : flat.items()) {
    for (std::string inner = place; !inner.empty(); inner.erase(inner.rfind('/'))) places.push_back(inner);
  }
  for (const std::string& place : places) {
    for (const Json& other : {Json(7), Json("x"), Json(true), Json(nullptr), Json::array({1}), Json{{"a", 1}}}) {
      Json metadata = whole;
      metadata[Json::json_pointer(place)] = other;
      write_file(folder() / "objective.json", metadata.dump());
      const ResultsFolder results = read_results_folder(folder());
      EXPECT_TRUE(is_in_page(report_page(results, ""), "objective.csv")) << metadata;
      EXPECT_TRUE(is_in_page(comparison_page({"a", results}, {"b", results}), "Two runs")) << metadata;
    }
  }
}

TEST_F(ReportOnDisk, TakesTheKeyOfATableFromItsMetadata) {
  write_file(folder() / "objective.csv", one_solve);
  write_file(folder() / "objective.json", R"({"command_line": ["objective"], "tables": {"objective.csv": {"schema":
    {"primaryKey": ["problem", "intervals"]}}}})");
  const ResultsFolder results = read_results_folder(folder());
  ASSERT_EQ(results.tables.size(), 1U);
  EXPECT_EQ(results.tables.front().table.key(), (std::vector<std::string>{"problem", "intervals"}));
}

TEST_F(ReportOnDisk, NamesTheFileAndTheKeyOfMetadataOfAnotherType) {
  write_file(folder() / "objective.csv", one_solve);
  for (const auto& [key, metadata] :
       {std::pair("complete", Json{{"command_line", {"x"}}, {"complete", "yes"}}),
        std::pair("command_line", Json{{"command_line", 7}}), std::pair("command_line 1", Json{{"command_line", {7}}}),
        std::pair("utc_time", Json{{"command_line", {"x"}}, {"utc_time", 7}})}) {
    write_file(folder() / "objective.json", metadata.dump());
    const std::string page = report_page(read_results_folder(folder()), "");
    EXPECT_TRUE(is_in_page(page, std::string("objective.json: ") + key + " is ")) << metadata;
  }
}

}  // namespace
}  // namespace dmocbench
