#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// Notes the JSON Schema of a table's rows (`row_schema`) in the entry of its file in a run's metadata,
/// `metadata["tables"][FILE]["schema"]`, which `describe_tables_of_run` completes.
void note_table(const std::filesystem::path& file, const Table& table, nlohmann::ordered_json& metadata);

/// Writes a table as a file, and notes its schema in the metadata of its run. Throws `Error` as `write_file`.
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

/// Sets `metadata["tables"]` to the description of the files by `describe_tables`, with the schemas that `note_table`
/// has noted. A column that they do not explain is described as in `rows`, a table with the columns of the run's own
/// rows.
void describe_tables_of_run(const std::vector<std::filesystem::path>& files, const Table& rows,
                            nlohmann::ordered_json& metadata);

/// The JSON Schema (draft 2020-12) of a row as an object: a property per column with its type, its meaning and, as
/// "unit", its unit, where they are known; all are required, others are not allowed. Empty fields are null, fields of
/// text columns are texts, other fields that parse as numbers are numbers; booleans are 0 or 1. "primaryKey" names the
/// columns of the key, which distinguishes rows; it is absent if no key is declared.
[[nodiscard]] nlohmann::ordered_json row_schema(const std::string& title, const Table& table);

}  // namespace dmocbench
