#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include <tl/expected.hpp>

#include "bench/run/column.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/findings.hpp"
#include "bench/run/kept_rows.hpp"
#include "bench/run/options.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// A table and the file that holds it.
struct TableFile {
  std::filesystem::path file;  ///< with its folder, NAME.csv
  Table table;                 ///< with what its columns mean
};

/// Writes tables, and beside them the metadata of their run with the JSON Schema of their rows. Columns that a table
/// leaves unexplained mean what the first table says. Rows that are kept of earlier runs stand before the others. The
/// metadata say `"complete": false` until all tables are there.
/// Throws `Error` if a file cannot be written.
void write_tables(const std::vector<TableFile>& tables, const std::filesystem::path& metadata_file,
                  const std::vector<std::string>& command_line, const KeptRows& kept = {});

/// A run of an experiment without cases (those have experiment.hpp): whole tables, written when all of them are there.
/// As long as it exists, an interrupt ends what this thread computes (`StopScope`).
class TableRun {
 public:
  /// Adds the options `--out`, `--quiet` and `--json`, reads the command line and takes the results `name` of that
  /// folder, so that no other run writes them meanwhile. Throws `Error` on bad input, or if nothing can be written
  /// there.
  TableRun(std::string name, CommandLine& line);

  /// Options for solvers, which stop if the run is to stop.
  [[nodiscard]] static SolverOptions solver_options();
  /// The problems that a user chose; their libraries and settings are written to the rows. Throws `Error` as
  /// `ProblemOptions::selected`.
  [[nodiscard]] std::vector<std::shared_ptr<const Problem>> selected(const ProblemOptions& asked);
  /// Says on a terminal what is being measured. Throws `Interrupted` if the run is to stop.
  void show(const std::string& activity) const;
  /// What is printed when the run ends.
  [[nodiscard]] Findings& findings() noexcept { return findings_; }
  /// Adds the table of a file, named without folder and ending. `not_measured`: rows that say why they lack a number.
  void add(const std::string& file, const Table& table, std::ptrdiff_t not_measured = 0);
  /// The same with what its columns mean, for the metadata.
  template <class Record>
  void add(const std::string& file, const Columns<Record>& columns, const std::vector<Record>& records,
           std::ptrdiff_t not_measured = 0) {
    add(file, table_of(columns, records), not_measured);
  }
  /// Writes all tables and their metadata, NAME.json, which say `"complete": false` meanwhile. Rows of a problem get
  /// its library and settings, and follow the rows of other problems that earlier runs have left in the file. Returns
  /// the exit code: 1 if a row was not measured. Throws `Error` if a file cannot be written.
  [[nodiscard]] int write() const;

 private:
  std::string name_;
  std::filesystem::path out_ = "results";
  Findings findings_;
  std::vector<std::string> command_line_;
  OutputFolder folder_;
  ResultLock lock_;
  mutable ProgressLine progress_;
  StopScope scope_;
  std::set<Statement> statements_;
  std::vector<TableFile> tables_;
  std::vector<std::string> rows_of_tables_;  ///< how many each has, in words
  std::ptrdiff_t not_measured_ = 0;          ///< rows of all tables
};

/// What `measure()` returns, or the sentence of the `Error` by which it refuses. Throws `Stopped` on, because a stop
/// that was asked for is no finding.
template <class Measure>
[[nodiscard]] tl::expected<std::invoke_result_t<const Measure&>, std::string> measured_or_reason(
    const Measure& measure) {
  try {
    return measure();
  } catch (const Stopped&) {
    throw;
  } catch (const Error& error) {
    return tl::unexpected<std::string>(error.what());
  }
}

}  // namespace dmocbench
