#include "bench/run/written_tables.hpp"

#include <algorithm>

#include <boost/crc.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/meanings.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"
#include "methods/runtime/counted.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

namespace {

std::string checksum_in_words(std::string_view content) { return fmt::format("{:08x}", crc_32(content)); }

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

}  // namespace

std::uint32_t crc_32(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return crc.checksum();
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
                    {"crc32", checksum_in_words(content)},
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
  if (const std::string checksum = checksum_in_words(content); told["crc32"] != checksum) {
    throw Error(fmt::format("{} is not as its run wrote it: its checksum is {}, and {} states {}", table, checksum,
                            source, told["crc32"].get<std::string>()));
  }
}

}  // namespace dmocbench
