#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// Adds what the columns of a table mean, "[s] median time of a solve", what they hold and which are its key to what a
/// run's metadata tell of its file, as `metadata["tables"][FILE]["meanings"]`, `["types"]` and `["key"]`, which
/// `describe_tables_of_run` reads.
/// Columns that the table lacks are left out.
void add_meanings(nlohmann::ordered_json& metadata, const std::filesystem::path& file, const Table& table);

/// Writes a table as a file, and what its columns mean to the metadata of its run. Throws `Error` as `write_file`.
void write_table(const std::filesystem::path& file, const Table& table, nlohmann::ordered_json& metadata);

/// `metadata["tables"]` becomes what `describe_tables` tells of the files, with the meanings of their columns: those
/// that `write_table` noted, or else those of `rows`, a table with the columns of the run's own rows; and with the JSON
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
  /// What it holds.
  FieldType type = {};
};

/// The JSON Schema (draft 2020-12) of a row as an object: a property per column with its type, its meaning and, as
/// "unit", its unit, where they are known; all are required, others are not allowed. Empty fields are null, those of
/// columns of texts texts, others that read as numbers numbers; booleans are 0 or 1. "primaryKey" names the columns of
/// the key, by which rows are told apart; none where nobody has said it.
[[nodiscard]] nlohmann::ordered_json row_schema(const std::string& title, const std::vector<DeclaredColumn>& columns,
                                                const std::vector<std::string>& key = {});

/// The JSON Schema of the rows of a table, by what it says of its columns itself.
[[nodiscard]] nlohmann::ordered_json row_schema(const std::string& title, const Table& table);

/// The JSON Schema of a run's metadata, NAME.json: what every run tells, and the schema of what it tells of its tables.
[[nodiscard]] nlohmann::ordered_json metadata_schema();

}  // namespace dmocbench
