#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/run/solve_case.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// A problem as it was stated to a run: name, file of its library (empty for a problem of the suite) and settings.
/// Rows of a results table belong to a statement. A run replaces the rows of its own statements and keeps all others.
struct Statement {
  std::string problem;   ///< name of the problem
  std::string library;   ///< name of the library's file, without its folder; empty for a problem of the suite
  std::string settings;  ///< parameters that differ from their defaults, as `Problem::settings` writes them
  /// By problem, then library, then settings.
  friend auto operator<=>(const Statement&, const Statement&) = default;
};

/// The statement of a problem of this process.
[[nodiscard]] Statement statement_of(const Problem& problem);

/// A table whose column `problem` is followed by `library` and `settings`, which become part of the key. Rows take them
/// from the statement of their problem. A table without the column `problem`, or that has the others, is returned
/// unchanged.
[[nodiscard]] Table with_statements(const Table& table, const std::set<Statement>& statements);

/// The rows that earlier runs of other statements have left in the tables FOLDER/NAME*.csv, and the description of
/// those runs in the metadata FOLDER/NAME.json.
class KeptRows {
 public:
  /// No rows.
  KeptRows() = default;
  /// Of a run with the prefix FOLDER/NAME and its own statements. Throws `Error` if the metadata of the earlier runs
  /// are damaged.
  KeptRows(std::filesystem::path prefix, std::set<Statement> own);
  /// Of a run of these cases. Instances count as the problem whose values they vary, and the settings of a row do not
  /// count then: a run over instances replaces all rows of its problems. Throws `Error` likewise.
  KeptRows(std::filesystem::path prefix, const std::vector<Case>& cases);

  /// The run's own statements.
  [[nodiscard]] const std::set<Statement>& own() const noexcept { return own_; }
  /// Reads the rows of other statements in a table, if the file exists. Throws `Error` that names the file if there are
  /// such rows and the metadata do not describe them.
  void read(const std::filesystem::path& file);
  /// Throws `Error` that names the file if it exists and its columns are not these.
  void require_columns(const std::filesystem::path& file, const std::vector<std::string>& columns) const;
  /// Throws `Error` that names the file if it is the motion of another statement.
  void require_no_other_motion(const std::filesystem::path& file) const;
  /// Number of rows that are kept in a file.
  [[nodiscard]] std::size_t count(const std::filesystem::path& file) const;
  /// The kept rows of a file, followed by the rows of a table. Rows of a file with other columns are not kept.
  [[nodiscard]] Table joined(const std::filesystem::path& file, const Table& own) const;
  /// Leaves only the kept rows in a file; removes it if it has none. Throws `Error` if it cannot be written.
  void reduce(const std::filesystem::path& file) const;
  /// Notes the own statements in the metadata of a run, and under "earlier_runs" the runs whose rows are kept.
  void describe_runs(nlohmann::ordered_json& metadata) const;
  /// Writes to the metadata whether the run came to its end ("run_complete"), and whether all runs did whose rows the
  /// tables hold ("complete").
  void describe_end(bool is_complete, nlohmann::ordered_json& metadata) const;
  /// Adds the earlier metadata of tables and motions that still exist and that the run does not write: `own` are the
  /// files that it writes.
  void describe_files(const std::vector<std::filesystem::path>& own, nlohmann::ordered_json& metadata) const;

 private:
  [[nodiscard]] bool is_own(const Statement& statement) const;
  void require_described(const std::filesystem::path& file) const;
  [[nodiscard]] nlohmann::ordered_json kept_runs() const;

  std::filesystem::path prefix_;
  std::set<Statement> own_;
  bool any_settings_ = false;
  nlohmann::ordered_json earlier_ = nlohmann::ordered_json::object();  ///< metadata of the latest run, if there are any
  std::map<std::filesystem::path, Table> kept_;                        ///< rows of other statements
};

}  // namespace dmocbench
