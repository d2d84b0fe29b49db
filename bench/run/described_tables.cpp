#include "bench/run/described_tables.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/result_file.hpp"
#include "bench/run/solve_case.hpp"
#include "methods/error.hpp"
#include "methods/program/status.hpp"
#include "methods/runtime/numbers_in_text.hpp"

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
bool is_status_of_solve(const std::string& name, const ColumnFacts& column) {
  return name == "status" && std::ranges::any_of(core_columns(), [&](const Column<SolvedCase>& core) {
           return core.name == name && core.meaning == column.meaning;
         });
}

/// The entry of a table in metadata; null if there is no such entry.
nlohmann::json entry_of(const nlohmann::json& metadata, const std::string& table) {
  const auto tables = metadata.is_object() ? metadata.find("tables") : metadata.end();
  if (tables == metadata.end() || !tables->is_object() || !tables->contains(table)) return {};
  const nlohmann::json& entry = tables->at(table);
  const auto has = [&](const char* name, auto is_of_type) { return entry.contains(name) && is_of_type(entry[name]); };
  const auto are_texts = [](const nlohmann::json& values) {
    return values.is_array() && std::ranges::all_of(values, [](const auto& value) { return value.is_string(); });
  };
  const bool is_whole = entry.is_object() && has("columns", are_texts) &&
                        has("rows", [](const auto& value) { return value.is_number_integer(); }) &&
                        has("crc32", [](const auto& value) { return value.is_string(); });
  return is_whole ? entry : nlohmann::json();
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

/// The property of a column in the schema of its rows.
Json property_of(const std::string& name, const ColumnFacts& column) {
  Json property = Json::object();
  if (!column.meaning.empty()) property["description"] = column.meaning;
  if (!column.unit.empty()) property["unit"] = column.unit;
  if (is_status_of_solve(name, column)) {
    property["enum"] = status_names();
  } else {
    add_type(column.type, property);
  }
  return property;
}

/// The facts that a table has of a column; none where another table explains it.
ColumnFacts facts_in(const Table& table, const std::string& column) {
  const auto found = table.facts().find(column);
  return found == table.facts().end() ? ColumnFacts{} : found->second;
}

Json schema_of(const std::string& title, const Json& properties, const std::vector<std::string>& key) {
  Json names = Json::array();
  for (const auto& [name, property] : properties.items()) names.push_back(name);
  return {{"$schema", draft},
          {"title", title},
          {"description",
           "a row: empty fields are null, fields of text columns are strings, and other fields that parse as numbers "
           "are numbers"},
          {"type", "object"},
          {"properties", properties},
          {"required", names},
          {"primaryKey", key},
          {"additionalProperties", false}};
}

}  // namespace

void note_table(const std::filesystem::path& file, const Table& table, nlohmann::ordered_json& metadata) {
  const std::string name = file.filename().string();
  metadata["tables"][name]["schema"] = row_schema(name, table);
}

void write_table(const std::filesystem::path& file, const Table& table, nlohmann::ordered_json& metadata) {
  write_file(file, table.csv());
  note_table(file, table, metadata);
}

nlohmann::ordered_json describe_tables(const std::vector<std::filesystem::path>& files) {
  nlohmann::ordered_json tables = nlohmann::ordered_json::object();
  for (const std::filesystem::path& file : files) {
    std::error_code none;  // a missing file is not a regular file
    if (file.extension() != ".csv" || !std::filesystem::is_regular_file(file, none)) continue;
    const std::string content = read_file(file);
    const Table table = Table::from_csv(content);
    const std::string name = file.filename().string();
    tables[name] = {{"columns", table.columns()},
                    {"rows", table.rows().size()},
                    {"crc32", checksum_of(content)},
                    {"schema", row_schema(name, Table(table.columns()))}};
  }
  return tables;
}

void require_as_written(const nlohmann::json& metadata, const std::string& source, const std::string& table,
                        std::string_view content) {
  const nlohmann::json entry = entry_of(metadata, table);
  if (entry.is_null()) throw Error("{} does not list {}: they come from different runs", source, table);
  const Table found = Table::from_csv(content);
  const auto columns = entry["columns"].get<std::vector<std::string>>();
  if (const std::string more = lacked(found.columns(), columns); !more.empty())
    throw Error("{} has the column {}, which {} does not list", table, more, source);
  if (const std::string missing = lacked(columns, found.columns()); !missing.empty())
    throw Error("{} lacks the column {}, which {} lists", table, missing, source);
  if (entry["rows"] != found.rows().size()) {
    throw Error("{} states {}, but {} has {}: the files come from different runs, or rows are missing", source,
                counted(entry["rows"].get<long long>(), "row"), table, found.rows().size());
  }
  if (const std::string checksum = checksum_of(content); entry["crc32"] != checksum) {
    throw Error("{} was changed after its run: its checksum is {}, but {} states {}", table, checksum, source,
                entry["crc32"].get<std::string>());
  }
}

void describe_tables_of_run(const std::vector<std::filesystem::path>& files, const Table& rows,
                            nlohmann::ordered_json& metadata) {
  const Json noted = metadata.value("tables", Json::object());
  Json tables = describe_tables(files);
  for (const auto& [file, entry] : tables.items()) {
    const Json of_file = noted.contains(file) ? noted.at(file).at("schema") : Json::object();
    const Json explained = of_file.value("properties", Json::object());
    Json properties = Json::object();
    for (const std::string& column : entry.at("columns").get<std::vector<std::string>>()) {
      if (explained.contains(column) && explained.at(column).contains("description")) {
        properties[column] = explained.at(column);
        continue;
      }
      ColumnFacts facts = facts_in(rows, column);
      facts.type.may_be_empty |= !of_file.empty();  // a summary may leave a column of the rows empty
      properties[column] = property_of(column, facts);
    }
    entry["schema"] = schema_of(file, properties, of_file.value("primaryKey", rows.key()));
  }
  metadata["tables"] = std::move(tables);
}

nlohmann::ordered_json row_schema(const std::string& title, const Table& table) {
  Json properties = Json::object();
  for (const std::string& column : table.columns()) properties[column] = property_of(column, facts_in(table, column));
  return schema_of(title, properties, table.key());
}

}  // namespace dmocbench
