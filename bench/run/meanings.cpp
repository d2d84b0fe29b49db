#include "bench/run/meanings.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/result_file.hpp"
#include "bench/run/solve_case.hpp"
#include "methods/error.hpp"
#include "methods/program/status.hpp"
#include "methods/runtime/counted.hpp"

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

/// True for the status column of solved cases, which holds only a status; other tables have more in theirs.
bool is_status_of_solve(const DeclaredColumn& column) {
  return column.name == "status" && std::ranges::any_of(core_columns(), [&](const Column<SolvedCase>& core) {
           return core.name == column.name && core.meaning == column.meaning;
         });
}

Json of_type(const char* type) { return {{"type", type}}; }

/// A column from its meaning as tables have it, "[s] median time of a solve".
DeclaredColumn declared(const std::string& name, const std::string& meaning, FieldType type) {
  const std::size_t end = meaning.starts_with('[') ? meaning.find("] ") : std::string::npos;
  if (end == std::string::npos) return {name, "", meaning, type};
  return {name, meaning.substr(1, end - 1), meaning.substr(end + 2), type};
}

/// The meaning that `add_meanings` has noted for a column of a file, or else its meaning in the run's own rows.
std::string meaning_of(const std::string& column, const Json& of_file, const Table& rows) {
  const Json meanings = of_file.value("meanings", Json::object());
  if (meanings.contains(column)) return meanings.at(column).get<std::string>();
  const auto of_rows = rows.meanings().find(column);
  return of_rows == rows.meanings().end() ? "" : of_rows->second;
}

/// Likewise its type. A summary may leave a column of the rows empty.
FieldType type_of(const std::string& column, const Json& of_file, const Table& rows) {
  const Json types = of_file.value("types", Json::object());
  if (types.contains(column)) {
    const Json& noted = types.at(column);
    return {static_cast<FieldKind>(noted.at(0).get<int>()), noted.at(1).get<bool>()};
  }
  const auto of_rows = rows.types().find(column);
  const bool has_other_meaning = of_file.value("meanings", Json::object()).contains(column);
  if (has_other_meaning || of_rows == rows.types().end()) return {};
  return {of_rows->second.kind, of_rows->second.may_be_empty || !of_file.empty()};
}

DeclaredColumn declaration_of(const std::string& column, const Json& of_file, const Table& rows) {
  return declared(column, meaning_of(column, of_file, rows), type_of(column, of_file, rows));
}

/// The entry of a table in metadata; null if there is no such entry.
nlohmann::json told_of(const nlohmann::json& metadata, const std::string& table) {
  const auto tables = metadata.is_object() ? metadata.find("tables") : metadata.end();
  if (tables == metadata.end() || !tables->is_object() || !tables->contains(table)) return {};
  const nlohmann::json& told = tables->at(table);
  const auto has = [&told](const char* name, auto is_of_type) { return told.contains(name) && is_of_type(told[name]); };
  const auto are_texts = [](const nlohmann::json& values) {
    return values.is_array() && std::ranges::all_of(values, [](const auto& value) { return value.is_string(); });
  };
  const bool is_whole = told.is_object() && has("columns", are_texts) &&
                        has("rows", [](const auto& value) { return value.is_number_integer(); }) &&
                        has("crc32", [](const auto& value) { return value.is_string(); });
  return is_whole ? told : nlohmann::json();
}

/// The first name that is missing from the others, in quotes; empty if there is no such name.
std::string lacked(const std::vector<std::string>& names, const std::vector<std::string>& others) {
  const auto found = std::ranges::find_if(
      names, [&](const std::string& name) { return std::ranges::find(others, name) == others.end(); });
  return found == names.end() ? "" : fmt::format("\"{}\"", *found);
}

/// Adds the type of a column's fields. Undeclared columns may hold numbers, texts and null.
void add_type(FieldType type, Json& property) {
  if (type.kind == FieldKind::boolean) {
    property["enum"] = {0, 1};
    if (type.may_be_empty) property["enum"].push_back(nullptr);
    return;
  }
  Json types = Json::array();
  if (type.kind == FieldKind::any || type.kind == FieldKind::number) types.push_back("number");
  if (type.kind == FieldKind::any || type.kind == FieldKind::text) types.push_back("string");
  if (type.kind == FieldKind::integer) types.push_back("integer");
  if (type.may_be_empty) types.push_back("null");
  property["type"] = types.size() == 1 ? types.front() : types;
}

}  // namespace

void add_meanings(nlohmann::ordered_json& metadata, const std::filesystem::path& file, const Table& table) {
  Json& told = metadata["tables"][file.filename().string()];
  if (told.is_null()) told = Json::object();
  told["key"] = table.key();
  for (const std::string& column : table.columns()) {
    const auto meaning = table.meanings().find(column);
    if (meaning != table.meanings().end()) told["meanings"][column] = meaning->second;
    const auto type = table.types().find(column);
    if (type != table.types().end())
      told["types"][column] = {static_cast<int>(type->second.kind), type->second.may_be_empty};
  }
}

void write_table(const std::filesystem::path& file, const Table& table, nlohmann::ordered_json& metadata) {
  write_file(file, table.csv());
  add_meanings(metadata, file, table);
}

nlohmann::ordered_json describe_tables(const std::vector<std::filesystem::path>& files) {
  nlohmann::ordered_json tables = nlohmann::ordered_json::object();
  for (const std::filesystem::path& file : files) {
    std::error_code none;  // a missing file is not a regular file
    if (file.extension() != ".csv" || !std::filesystem::is_regular_file(file, none)) continue;
    const std::string content = read_file(file);
    const Table table = Table::from_csv(content);
    const std::string name = file.filename().string();
    std::vector<DeclaredColumn> columns;
    for (const std::string& column : table.columns()) columns.push_back({.name = column, .unit = {}, .meaning = {}});
    tables[name] = {{"columns", table.columns()},
                    {"rows", table.rows().size()},
                    {"crc32", checksum_of(content)},
                    {"schema", row_schema(name, columns)}};
  }
  return tables;
}

void require_as_written(const nlohmann::json& metadata, const std::string& source, const std::string& table,
                        std::string_view content) {
  const nlohmann::json told = told_of(metadata, table);
  if (told.is_null()) throw Error(fmt::format("{} does not list {}: they are of different runs", source, table));
  const Table found = Table::from_csv(content);
  const auto columns = told["columns"].get<std::vector<std::string>>();
  if (const std::string more = lacked(found.columns(), columns); !more.empty())
    throw Error(fmt::format("{} has the column {}, which {} does not list", table, more, source));
  if (const std::string missing = lacked(columns, found.columns()); !missing.empty())
    throw Error(fmt::format("{} lacks the column {}, which {} lists", table, missing, source));
  if (told["rows"] != found.rows().size()) {
    throw Error(fmt::format("{} states {} and {} has {}: they are of different runs, or rows are lost", source,
                            counted(told["rows"].get<long long>(), "row"), table, found.rows().size()));
  }
  if (const std::string checksum = checksum_of(content); told["crc32"] != checksum) {
    throw Error(fmt::format("{} is not as its run wrote it: its checksum is {}, and {} states {}", table, checksum,
                            source, told["crc32"].get<std::string>()));
  }
}

void describe_tables_of_run(const std::vector<std::filesystem::path>& files, const Table& rows,
                            nlohmann::ordered_json& metadata) {
  const Json noted = metadata.value("tables", Json::object());
  Json tables = describe_tables(files);
  for (const auto& [file, told] : tables.items()) {
    const Json of_file = noted.value(file, Json::object());
    const auto key = of_file.value("key", rows.key());
    const auto columns = told.at("columns").get<std::vector<std::string>>();  // an entry more may move the others
    std::vector<DeclaredColumn> declarations;
    for (const std::string& column : columns) {
      declarations.push_back(declaration_of(column, of_file, rows));
      if (const std::string meaning = meaning_of(column, of_file, rows); !meaning.empty())
        told["meanings"][column] = meaning;
    }
    told["schema"] = row_schema(file, declarations, key);
  }
  metadata["tables"] = std::move(tables);
}

nlohmann::ordered_json row_schema(const std::string& title, const std::vector<DeclaredColumn>& columns,
                                  const std::vector<std::string>& key) {
  Json properties = Json::object();
  Json names = Json::array();
  for (const DeclaredColumn& column : columns) {
    Json& property = properties[column.name];
    if (!column.meaning.empty()) property["description"] = column.meaning;
    if (!column.unit.empty()) property["unit"] = column.unit;
    if (is_status_of_solve(column)) {
      property["enum"] = status_names();
    } else {
      add_type(column.type, property);
    }
    names.push_back(column.name);
  }
  return {
      {"$schema", draft},
      {"title", title},
      {"description",
       "a row; empty fields are null, fields of text columns are texts, other fields that parse as numbers numbers"},
      {"type", "object"},
      {"properties", properties},
      {"required", names},
      {"primaryKey", key},
      {"additionalProperties", false}};
}

nlohmann::ordered_json row_schema(const std::string& title, const Table& table) {
  std::vector<DeclaredColumn> columns;
  for (const std::string& column : table.columns()) columns.push_back(declaration_of(column, Json::object(), table));
  return row_schema(title, columns, table.key());
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
  const Json statements = {{"type", "array"},
                           {"items",
                            {{"type", "object"},
                             {"properties", {{"problem", text}, {"library", text}, {"settings", text}}},
                             {"required", {"problem", "library", "settings"}},
                             {"additionalProperties", false}}}};
  const Json earlier = {{"type", "object"},
                        {"properties", {{"statements", statements}, {"complete", of_type("boolean")}}},
                        {"required", {"statements", "complete"}}};
  const Json properties = {{"command_line", texts},
                           {"utc_time", {{"type", "string"}, {"pattern", "^[0-9-]+T[0-9:]+Z$"}}},
                           {"wall_seconds", {{"type", "number"}, {"minimum", 0}}},
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
                           {"statements", statements},
                           {"earlier_runs", {{"type", "array"}, {"items", earlier}}},
                           {"run_complete", of_type("boolean")},
                           {"complete", of_type("boolean")},
                           {"cases", count},
                           {"rows", count},
                           {"not_solved", count},
                           {"too_coarse", count},
                           {"violates_between_stages", count},
                           {"on_another_branch", count},
                           {"tables", {{"type", "object"}, {"additionalProperties", table}}}};
  return {
      {"$schema", draft},
      {"title", "metadata of a run"},
      {"description", "NAME.json next to the tables of a run; experiments add their own properties"},
      {"type", "object"},
      {"properties", properties},
      {"required",
       {"command_line", "utc_time", "commit", "dmocbench", "compiler", "flags", "processor", "complete", "tables"}}};
}

}  // namespace dmocbench
