#include "bench/experiment/meanings.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "bench/experiment/solve_case.hpp"
#include "methods/program/status.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* draft = "https://json-schema.org/draft/2020-12/schema";

/// The statuses that a solve may end with, by their names in tables.
Json status_names() {
  Json names = Json::array();
  for (int status = 0; status <= static_cast<int>(Status::not_confirmed); ++status) {
    names.push_back(name_of(static_cast<Status>(status)));
  }
  return names;
}

/// True of the column of solved cases, which holds nothing else; other tables say more in theirs.
bool is_status_of_solve(const DeclaredColumn& column) {
  return column.name == "status" && std::ranges::any_of(core_columns(), [&](const Column<SolvedCase>& core) {
           return core.name == column.name && core.meaning == column.meaning;
         });
}

Json of_type(const char* type) { return {{"type", type}}; }

}  // namespace

void add_meanings(nlohmann::ordered_json& tables, const std::filesystem::path& file,
                  const std::vector<DeclaredColumn>& columns) {
  const std::string name = file.filename().string();
  if (!tables.contains(name)) return;
  for (const DeclaredColumn& column : columns) {
    const std::string unit = column.unit.empty() ? "" : "[" + column.unit + "] ";
    tables[name]["meanings"][column.name] = unit + column.meaning;
  }
  tables[name]["schema"] = row_schema(name, columns);
}

nlohmann::ordered_json row_schema(const std::string& title, const std::vector<DeclaredColumn>& columns) {
  Json properties = Json::object();
  Json names = Json::array();
  for (const DeclaredColumn& column : columns) {
    Json& property = properties[column.name];
    if (!column.meaning.empty()) property["description"] = column.meaning;
    if (!column.unit.empty()) property["unit"] = column.unit;
    if (is_status_of_solve(column)) {
      property["enum"] = status_names();
    } else {
      property["type"] = {"number", "string", "null"};
    }
    names.push_back(column.name);
  }
  return {{"$schema", draft},
          {"title", title},
          {"description", "a row; fields that read as numbers are numbers, empty ones null"},
          {"type", "object"},
          {"properties", properties},
          {"required", names},
          {"additionalProperties", false}};
}

nlohmann::ordered_json metadata_schema() {
  const Json text = of_type("string");
  const Json count = {{"type", "integer"}, {"minimum", 0}};
  const Json texts = {{"type", "array"}, {"items", text}};
  const Json by_name = {{"type", "object"}, {"additionalProperties", text}};
  const Json table = {{"type", "object"},
                      {"properties",
                       {{"columns", texts},
                        {"rows", count},
                        {"crc32", {{"type", "string"}, {"pattern", "^[0-9a-f]{8}$"}}},
                        {"meanings", by_name},
                        {"schema", of_type("object")}}},
                      {"required", {"columns", "rows", "crc32", "schema"}},
                      {"additionalProperties", false}};
  const Json properties = {{"command_line", texts},
                           {"utc_time", {{"type", "string"}, {"pattern", "^[0-9-]+T[0-9:]+Z$"}}},
                           {"commit", text},
                           {"dmocbench", text},
                           {"compiler", text},
                           {"flags", text},
                           {"instruction_set", text},
                           {"processor", text},
                           {"cores", {{"type", "integer"}, {"minimum", 1}}},
                           {"memory_gib", of_type("number")},
                           {"operating_system", text},
                           {"libraries", of_type("object")},
                           {"solvers", by_name},
                           {"complete", of_type("boolean")},
                           {"cases", count},
                           {"rows", count},
                           {"not_solved", count},
                           {"too_coarse", count},
                           {"on_another_branch", count},
                           {"tables", {{"type", "object"}, {"additionalProperties", table}}}};
  return {
      {"$schema", draft},
      {"title", "metadata of a run"},
      {"description", "NAME.json beside the tables of a run; experiments add properties of their own"},
      {"type", "object"},
      {"properties", properties},
      {"required",
       {"command_line", "utc_time", "commit", "dmocbench", "compiler", "flags", "processor", "complete", "tables"}}};
}

}  // namespace dmocbench
