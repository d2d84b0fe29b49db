#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "bench/claims/read_rows.hpp"
#include "bench/tables/selection.hpp"
#include "methods/error.hpp"

namespace dmocbench {

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
