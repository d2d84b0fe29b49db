#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include <tl/expected.hpp>

#include "bench/run/column.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/kept_rows.hpp"
#include "bench/run/options.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/row_store.hpp"
#include "bench/run/run_summary.hpp"
#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// A table of a run, and the file that holds it.
struct TableFile {
  std::filesystem::path file;       ///< with its folder, NAME.csv
  Table table;                      ///< with the meanings of its columns
  std::ptrdiff_t not_measured = 0;  ///< rows that state why they lack a number
};

/// The entry of a stage in the store of a run: its name, and the tables that it has added with their declarations.
/// Tables are named without a folder, because the store may be a copy in another folder.
[[nodiscard]] nlohmann::ordered_json entry_of_stage(const std::string& stage, const std::vector<TableFile>& added);
/// The tables in such an entry, for the folder of the store. Throws `Error` that names the store if others have written
/// something else, or a table whose name does not begin with the one of the store.
[[nodiscard]] std::vector<TableFile> tables_of_stage(const nlohmann::ordered_json& entry,
                                                     const std::filesystem::path& store);

/// A run of an experiment without cases (those have experiment.hpp): whole tables, written when all of them are there.
/// As long as it exists, an interrupt ends this thread's computations (`StopScope`).
class TableRun {
 public:
  /// Whether an interrupted run is resumed by the same command: its work is then divided into stages.
  enum class Resumes : bool { no, yes };

  /// Adds the options `--out`, `--quiet`, `--json` and, if it resumes, `--fresh`; reads the command line and locks the
  /// results `name` of the output folder against other runs. Throws `Error` on bad input, or if files cannot be written
  /// there.
  TableRun(std::string name, CommandLine& line, Resumes resumes = Resumes::no);

  /// Options for solvers, which stop if the run is to stop.
  [[nodiscard]] static SolverOptions solver_options();
  /// The problems that a user chose; their libraries and settings are written to the rows. Throws `Error` as
  /// `ProblemOptions::selected`.
  [[nodiscard]] std::vector<std::shared_ptr<const Problem>> selected(const ProblemOptions& asked);
  /// Shows on a terminal what is being measured. Throws `Interrupted` if a stop was requested.
  void show(const std::string& activity) const;
  /// The summary, printed when the run ends.
  [[nodiscard]] RunSummary& summary() noexcept { return summary_; }
  /// Calls `measure`, which adds tables, unless the interrupted run that this one resumes has finished the stage; its
  /// rows are then in the tables already. A stage that is over is saved in NAME.rows.
  void stage(const std::string& name, const std::function<void()>& measure);
  /// The table of a file so far. Throws `Error` if no stage has added it.
  [[nodiscard]] const Table& table(const std::string& file) const;
  /// Adds the table of a file, named without folder and ending; its rows follow the rows that are there.
  /// `not_measured`: rows that state why they lack a number.
  void add(const std::string& file, const Table& table, std::ptrdiff_t not_measured = 0);
  /// The same with the meanings of its columns, for the metadata.
  template <class Record>
  void add(const std::string& file, const Columns<Record>& columns, const std::vector<Record>& records,
           std::ptrdiff_t not_measured = 0) {
    add(file, table_of(columns, records), not_measured);
  }
  /// Writes all tables and their metadata, NAME.json, which contain `"complete": false` meanwhile. Rows of a problem
  /// get its library and settings, and follow the rows of other problems that earlier runs have left in the file.
  /// Returns the exit code: 1 if a row was not measured. Throws `Error` if a file cannot be written.
  [[nodiscard]] int write() const;

 private:
  void resume();
  void take(TableFile added);

  std::string name_;
  std::filesystem::path out_ = "results";
  RunSummary summary_;
  bool fresh_ = false;
  std::vector<std::string> command_line_;
  OutputFolder folder_;
  ResultLock lock_;
  mutable ProgressLine progress_;
  StopScope scope_;
  std::set<Statement> statements_;
  std::vector<TableFile> tables_;
  std::vector<TableFile> added_;  ///< in this stage
  std::set<std::string> stages_;  ///< that are over
  RowStore store_;
};

/// The result of `measure()`, or the sentence of the `Error` that it throws. Rethrows `Stopped`, because a requested
/// stop is not a finding.
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
