#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// Adds the meanings of a table's columns, "[s] median time of a solve", their types and its key to the entry of its
/// file in a run's metadata, as `metadata["tables"][FILE]["meanings"]`, `["types"]` and `["key"]`, which
/// `describe_tables_of_run` reads.
/// Columns that the table lacks are left out.
void add_meanings(nlohmann::ordered_json& metadata, const std::filesystem::path& file, const Table& table);

/// Writes a table as a file, and the meanings of its columns to the metadata of its run. Throws `Error` as
/// `write_file`.
void write_table(const std::filesystem::path& file, const Table& table, nlohmann::ordered_json& metadata);

/// The description of the tables that a run has written, as `metadata["tables"]`: an object per file by its
/// name without folder, with its columns, the number of its rows, its checksum ("crc32", eight hexadecimal digits) and
/// the JSON Schema of its rows. Paths that do not exist or are not regular .csv files are left out. Throws
/// `Error` if one cannot be read.
[[nodiscard]] nlohmann::ordered_json describe_tables(const std::vector<std::filesystem::path>& files);

/// Throws `Error` unless a table's content agrees with the metadata: columns, number of rows, checksum.
/// `table` and `source` are the names of the table's file and of the metadata file, for the sentence.
void require_as_written(const nlohmann::json& metadata, const std::string& source, const std::string& table,
                        std::string_view content);

/// Sets `metadata["tables"]` to the description of the files by `describe_tables`, with the meanings of their columns
/// (noted by `write_table`, or else from `rows`, a table with the columns of the run's own rows) and with the JSON
/// Schema of their rows (`row_schema`).
void describe_tables_of_run(const std::vector<std::filesystem::path>& files, const Table& rows,
                            nlohmann::ordered_json& metadata);

/// A column of a table without its values.
struct DeclaredColumn {
  /// As in the first line of a table.
  std::string name;
  /// Empty for a pure number.
  std::string unit;
  /// In words.
  std::string meaning;
  /// Its type.
  FieldType type = {};
};

/// The JSON Schema (draft 2020-12) of a row as an object: a property per column with its type, its meaning and, as
/// "unit", its unit, where they are known; all are required, others are not allowed. Empty fields are null, fields of
/// text columns are texts, other fields that parse as numbers are numbers; booleans are 0 or 1. "primaryKey" names the
/// columns of the key, which distinguishes rows; it is absent if no key is declared.
[[nodiscard]] nlohmann::ordered_json row_schema(const std::string& title, const std::vector<DeclaredColumn>& columns,
                                                const std::vector<std::string>& key = {});

/// The JSON Schema of the rows of a table, from its own declarations of its columns.
[[nodiscard]] nlohmann::ordered_json row_schema(const std::string& title, const Table& table);

/// The JSON Schema of a run's metadata, NAME.json: the properties that every run has, including its tables' entries.
[[nodiscard]] nlohmann::ordered_json metadata_schema();

}  // namespace dmocbench
