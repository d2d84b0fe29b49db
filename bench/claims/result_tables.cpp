#include "bench/claims/result_tables.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/described_tables.hpp"
#include "bench/run/json_place.hpp"
#include "methods/runtime/numbers_in_text.hpp"

// Reads the tables by which claims are judged, each with the metadata of its run.

namespace dmocbench {

namespace {

/// The fields read from the rows of one table, by their records.
using RowsOfTable = std::map<std::size_t, const ReadFields::ReadRow*>;

/// The rows grouped by table, according to their places ("objective.csv, record 2").
std::map<std::string, RowsOfTable> by_tables(const ReadFields& fields) {
  constexpr std::string_view mark = ", record ";
  std::map<std::string, RowsOfTable> tables;
  for (const auto& [place, row] : fields.rows()) {
    const std::size_t at = place.rfind(mark);
    if (at == std::string::npos) continue;
    if (const auto record = parsed<std::size_t>(std::string_view(place).substr(at + mark.size())))
      tables[place.substr(0, at)][*record] = &row;
  }
  return tables;
}

ReadRows rows_behind(const std::string& table, const RowsOfTable& rows) {
  const bool has_numbers = std::ranges::any_of(rows, [](const auto& row) { return row.second->has_number; });
  ReadRows result{.table = table, .records = {}, .columns = {}};
  std::set<std::string> columns;
  for (const auto& [record, row] : rows) {
    if (has_numbers && !row->has_number) continue;
    result.records.push_back(record);
    columns.insert(row->columns.begin(), row->columns.end());
  }
  result.columns.assign(columns.begin(), columns.end());
  return result;
}

}  // namespace

std::map<std::string, std::set<std::string>> read_columns(const ReadFields& fields) {
  std::map<std::string, std::set<std::string>> columns;
  for (const auto& [table, rows] : by_tables(fields)) {
    for (const auto& [record, row] : rows) columns[table].insert(row->columns.begin(), row->columns.end());
  }
  return columns;
}

std::vector<ReadRows> read_rows(const ReadFields& fields) {
  std::vector<ReadRows> result;
  for (const auto& [table, rows] : by_tables(fields)) result.push_back(rows_behind(table, rows));
  return result;
}

std::string packed_ranges(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : " ", numbers[i]);
    if (last > i) text += fmt::format("-{}", numbers[last]);
    i = last + 1;
  }
  return text;
}

namespace {

/// True of columns of numbers alone.
bool is_of_numbers(const JsonPlace& property) {
  const std::string types = property.has("type") ? property.at("type").json().dump() : "";
  const auto has = [&types](const char* type) { return types.find(type) != std::string::npos; };
  return (has("number") || has("integer")) && !has("string");
}

/// Throws `Error` unless the table has each of its columns once, including the columns of its key.
void check_columns(const Table& table, const std::string& file, const ColumnNames& key) {
  if (key.empty()) throw Error("the key columns that distinguish the rows of {} are not declared", file);
  ColumnNames columns = key;
  columns.insert(columns.end(), table.columns().begin(), table.columns().end());
  for (const std::string& column : columns) {
    const auto count = std::ranges::count(table.columns(), column);
    if (count != 1) throw Error("{} has {} column {}", file, count == 0 ? "no" : "more than one", column);
  }
}

/// Throws `Error` unless every row has a key of its own.
void check_keys(const Table& table, const ColumnNames& key) {
  std::map<std::vector<std::string>, const Row*> seen;
  for (const Row& row : table.rows()) {
    std::vector<std::string> fields;
    for (const std::string& column : key) fields.push_back(row.text(column));
    if (const auto [first, is_new] = seen.try_emplace(fields, &row); !is_new) {
      throw Error("{} has the same key as {}: {}", row.place(), first->second->place(), fmt::join(fields, ", "));
    }
  }
}

/// Throws `Error` unless the table agrees with the JSON Schema of its rows: its columns, a unique key in every row, and
/// finite numbers, which must not be missing in the key.
void check(const Table& table, const std::string& file, const JsonPlace& schema) {
  const ColumnNames key = schema.at("primaryKey").texts();
  check_columns(table, file, key);
  check_keys(table, key);
  for (const std::string& column : table.columns()) {
    if (!is_of_numbers(schema.at("properties").at(column))) continue;
    const bool may_be_missing = std::ranges::count(key, column) == 0;
    for (const Row& row : table.rows()) {
      if (!may_be_missing || !row.text(column).empty()) static_cast<void>(row.needed(column));
    }
  }
}

/// The longest beginning of a table's name, up to its end or a "_", that is the name of a run with such a file or
/// folder; empty if there is no such file.
std::string run_of(const std::filesystem::path& folder, std::string name, const char* ending) {
  std::error_code unknown;
  while (!name.empty() && !std::filesystem::exists(folder / (name + ending), unknown)) {
    name.resize(name.find('_') == std::string::npos ? 0 : name.rfind('_'));
  }
  return name;
}

/// Reads a regular file; pipes are rejected because they could block.
std::string content_of(const std::filesystem::path& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown))
    throw Error("{} is not a regular file", path.filename().string());
  return read_file(path);
}

/// Throws `Error` if there are parts of a run instead of its table.
void refuse_parts(const std::filesystem::path& folder, const std::string& table) {
  const std::string run = run_of(folder, table, ".parts");
  if (run.empty()) return;
  throw Error("{0}.csv is missing, but parts of {1} exist: run its command with --join {2}", table, run,
              folder.string());
}

/// The metadata of a run that ended with all its cases. Throws `Error` otherwise.
nlohmann::ordered_json metadata_of_whole_run(const std::filesystem::path& folder, const std::string& file) {
  nlohmann::ordered_json metadata = json_or_null(content_of(folder / file));
  const auto complete = metadata.is_object() ? metadata.find("complete") : metadata.end();
  if (!metadata.is_object() || complete == metadata.end() || !complete->is_boolean()) {
    throw Error("{} does not state whether the run was completed", file);
  }
  if (!complete->get<bool>()) throw Error("according to {}, the run was interrupted; run it again", file);
  if (metadata.contains("cases") && metadata["cases"] != metadata.value("rows", nlohmann::ordered_json())) {
    throw Error("{} lists {} cases, not all of which have a row; run it again", file, metadata["cases"].dump());
  }
  return metadata;
}

/// Throws `Error` unless the run that wrote the table came to its end, wrote this content, and the content agrees
/// with the JSON Schema next to it.
void check_run(const std::filesystem::path& folder, const std::string& name, const Table& table,
               const std::string& content) {
  const std::string run = run_of(folder, name, ".json");
  if (run.empty()) throw Error("the .json file next to it, which states whether its run was completed, is missing");
  const std::string source = run + ".json";
  const nlohmann::ordered_json metadata = metadata_of_whole_run(folder, source);
  const std::string file = name + ".csv";
  try {
    require_as_written(metadata, source, file, content);
    check(table, file, JsonPlace(metadata, source).at("tables").at(file).at("schema"));
  } catch (const Error& error) {
    throw Error("{}; run it again", error.what());
  }
}

/// Claims are about problems without changed settings: of a problem with rows of several libraries or settings, only
/// those without either.
Table of_plain_statements(const Table& table) {
  std::map<std::string, std::set<std::pair<std::string, std::string>>> statements;
  const auto statement = [](const Row& row) { return std::pair(row.text("library"), row.text("settings")); };
  for (const Row& row : table.rows()) statements[row.text("problem")].insert(statement(row));
  Table result = table;
  result.clear();
  for (const Row& row : table.rows()) {
    if (statements[row.text("problem")].size() == 1 || statement(row) == std::pair(std::string(), std::string()))
      result.append(row);
  }
  return result;
}

}  // namespace

ResultTables ResultTables::read(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) throw Error("there is no folder {}", folder.string());
  ResultTables tables;
  tables.folder_ = folder;
  return tables;
}

ResultTables::LoadedTable ResultTables::load(const std::filesystem::path& folder, const std::string& name) {
  const ReadFields no_evidence;  // these fields are read from every table
  LoadedTable loaded;
  const std::string file = name + ".csv";
  try {
    if (std::error_code unknown; !std::filesystem::exists(folder / file, unknown)) {
      refuse_parts(folder, name);
      return loaded;
    }
    const std::string content = content_of(folder / file);
    loaded.table = Table::from_csv(content);
    loaded.table->name_places(file);
    check_run(folder, name, *loaded.table, content);
    loaded.table = of_plain_statements(*loaded.table);
  } catch (const Error& error) {
    const std::string sentence = error.what();
    const bool names_it = sentence.find(file) != std::string::npos;
    loaded.fault = names_it ? sentence : fmt::format("{}: {}", file, sentence);
  }
  return loaded;
}

const ResultTables::LoadedTable& ResultTables::loaded(std::string_view table) const {
  const auto found = loaded_.find(table);
  if (found != loaded_.end()) return found->second;
  const std::string name(table);
  return loaded_.emplace(name, folder_.empty() ? LoadedTable() : load(folder_, name)).first->second;
}

void ResultTables::add(const std::string& name, Table table) {
  table.name_places(name + ".csv");
  loaded_[name] = {.table = std::move(table), .fault = ""};
}

bool ResultTables::has(std::string_view table) const {
  const LoadedTable& found = loaded(table);
  return found.table || !found.fault.empty();
}

bool ResultTables::has_any() const {
  return std::ranges::any_of(loaded_, [this](const auto& of_name) { return has(of_name.first); });
}

Selection ResultTables::rows(std::string_view table) const {
  const LoadedTable& found = loaded(table);
  if (!found.fault.empty()) throw Error(found.fault);
  if (!found.table) throw Error("there is no {}.csv", table);
  return *found.table;
}

Selection ResultTables::rows(std::string_view table, std::string_view problem) const {
  Selection of_problem = rows(table).where("problem", problem);
  if (of_problem.empty()) throw Error("{}.csv has no row of {}", table, problem);
  return of_problem;
}

void ResultTables::require_columns(const ReadFields& fields) const {
  for (const auto& [file, columns] : read_columns(fields)) {
    const auto& table = loaded(file.substr(0, file.rfind('.'))).table;
    for (const std::string& column : columns) {
      if (table && std::ranges::count(table->columns(), column) == 0) throw Error("{} has no column {}", file, column);
    }
  }
}

}  // namespace dmocbench
