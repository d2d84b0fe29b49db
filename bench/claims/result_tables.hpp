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

/// The tables of a results folder by their names without ".csv", each read when it is asked for.
///
/// The run that wrote a table is the one whose name the table's begins with; its metadata have to state that the run
/// was complete and wrote this content, and the JSON Schema of the rows there tells the key and the numbers. Of a
/// problem with rows of several settings only those without settings count. A table that is not as described throws
/// when its rows are asked for, so that it stops no claim but those that need it.
class ResultTables {
 public:
  ResultTables() = default;
  /// The tables of a folder. Throws `Error` if there is no such folder.
  [[nodiscard]] static ResultTables read(const std::filesystem::path& folder);

  /// Adds a table, or puts it in the place of one. Errors in numbers name the table and the record.
  void add(const std::string& name, Table table);
  /// Reads a table again when it is asked for the next time.
  void forget(const std::string& name) { sought_.erase(name); }
  /// Whether there is such a table, be it as it should or not.
  [[nodiscard]] bool has(std::string_view table) const;
  /// Whether there is any of the tables that were asked for.
  [[nodiscard]] bool has_any() const;
  /// The rows of a table. Throws `Error` that says what is wrong with it, or that it is not there.
  [[nodiscard]] Selection rows(std::string_view table) const;
  /// Those of one problem. Throws also if there is none.
  [[nodiscard]] Selection rows(std::string_view table, std::string_view problem) const;
  /// Throws `Error` that names a column which was read, by name, of a table that does not have it.
  void require_columns(const ReadFields& fields) const;

 private:
  /// What was found of a table that was asked for.
  struct Sought {
    std::optional<Table> table;  ///< none if it is not there
    std::string fault;           ///< what is wrong with it, in a sentence
  };
  [[nodiscard]] static Sought sought_in(const std::filesystem::path& folder, const std::string& name);
  [[nodiscard]] const Sought& sought(std::string_view table) const;

  std::filesystem::path folder_;
  mutable std::map<std::string, Sought, std::less<>> sought_;  ///< by name
};

}  // namespace dmocbench
