#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bench/tables/selection.hpp"
#include "methods/error.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// The rows of a table by which a claim was judged.
struct ReadRows {
  std::string table;                 ///< its file, without folder
  std::vector<std::size_t> records;  ///< of the rows whose numbers were read, in order; the header is record 1
  std::vector<std::string> columns;  ///< that were read of these rows, numbers and texts, by their names
};

/// The columns that were read, by the files of their tables, including columns used only to select rows.
[[nodiscard]] std::map<std::string, std::set<std::string>> read_columns(const ReadFields& fields);

/// The rows read, table by table. For a table from which only texts were read, the rows of these texts.
[[nodiscard]] std::vector<ReadRows> read_rows(const ReadFields& fields);

/// Whole numbers in order as a text: "2-5 9".
[[nodiscard]] std::string packed_ranges(const std::vector<std::size_t>& numbers);

/// The tables of a results folder by their names without ".csv", each read on first use.
///
/// The name of a table begins with the name of the run that wrote it. The run's metadata must state that the run was
/// complete and wrote this content; their JSON Schema of the rows gives the key and the numeric columns. For a problem
/// with rows of several settings only the rows without settings count. A table that does not meet this description
/// throws when its rows are requested, so that it affects only the claims that need it.
class ResultTables {
 public:
  ResultTables() = default;
  /// The tables of a folder. Throws `Error` if there is no such folder.
  [[nodiscard]] static ResultTables read(const std::filesystem::path& folder);

  /// Adds a table, or puts it in the place of one. Errors in numbers name the table and the record.
  void add(const std::string& name, Table table);
  /// Reads a table again on its next use.
  void forget(const std::string& name) { loaded_.erase(name); }
  /// Whether there is such a table, valid or not.
  [[nodiscard]] bool has(std::string_view table) const;
  /// Whether any of the requested tables exists.
  [[nodiscard]] bool has_any() const;
  /// The rows of a table. Throws `Error` with the fault of the table, or if it does not exist.
  [[nodiscard]] Selection rows(std::string_view table) const;
  /// The rows of one problem. Also throws if there are none.
  [[nodiscard]] Selection rows(std::string_view table, std::string_view problem) const;
  /// Throws `Error` that names a column which was read, by name, of a table that does not have it.
  void require_columns(const ReadFields& fields) const;

 private:
  /// The result of looking for a table.
  struct LoadedTable {
    std::optional<Table> table;  ///< empty if it does not exist
    std::string fault;           ///< its fault, in a sentence
  };
  [[nodiscard]] static LoadedTable load(const std::filesystem::path& folder, const std::string& name);
  [[nodiscard]] const LoadedTable& loaded(std::string_view table) const;

  std::filesystem::path folder_;
  mutable std::map<std::string, LoadedTable, std::less<>> loaded_;  ///< by name
};

}  // namespace dmocbench
