#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/tables/selection.hpp"
#include "methods/error.hpp"

namespace dmocbench {

/// What a table has to look like before a claim may be judged by it.
struct DeclaredTable {
  std::string name;        ///< without ".csv"
  std::string run;         ///< whose .json tells whether it is whole, without ".json"
  ColumnNames key;         ///< no two rows agree in all of them; those that count something are finite numbers
  ColumnNames texts = {};  ///< further columns that rows are picked by
};

/// The tables that claims read; they read no other.
[[nodiscard]] const std::vector<DeclaredTable>& declared_tables();

/// Adds a table that claims read.
void declare_table(DeclaredTable table);

/// There is no such table at all; any other `Error` says what is wrong with one that is there.
class MissingTable : public Error {
 public:
  using Error::Error;
};

/// The tables of a results folder by their names without ".csv".
///
/// A table that is no table, does not fit its declaration or is not whole throws when its rows are asked for, so that
/// it stops no claim but those that need it.
class ResultTables {
 public:
  ResultTables() = default;
  /// Reads the declared tables and the .json beside them. Throws `Error` if there is no such folder, or none
  /// of them is in it.
  [[nodiscard]] static ResultTables read(const std::filesystem::path& folder);

  /// Reads one declared table and the .json beside it as they are now.
  void read_table(const std::filesystem::path& folder, const DeclaredTable& declared);

  /// Errors in numbers name the table and the record.
  void add(const std::string& name, Table table);
  [[nodiscard]] bool has(std::string_view table) const { return tables_.contains(table) || faults_.contains(table); }
  /// The rows of a table. Throws `MissingTable` if it is not there, and `Error` that says what is wrong with it.
  [[nodiscard]] Selection rows(std::string_view table) const;
  /// Those of one problem. Throws also if there is none.
  [[nodiscard]] Selection rows(std::string_view table, std::string_view problem) const;

 private:
  std::map<std::string, Table, std::less<>> tables_;
  std::map<std::string, std::string, std::less<>> faults_;  ///< sentences by table
};

}  // namespace dmocbench
