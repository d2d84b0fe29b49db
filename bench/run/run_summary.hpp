#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "bench/run/command_line.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// How the solves of an experiment's table ended.
struct Outcome {
  std::ptrdiff_t failures = 0;      ///< neither solved nor no motions (`is_no_motion`)
  std::ptrdiff_t too_coarse = 0;    ///< rows whose intervals do not join
  std::ptrdiff_t violating = 0;     ///< rows whose motions violate constraints between stages
  std::ptrdiff_t other_branch = 0;  ///< rows whose answers are on another branch than their start
  /// Curves without a usable row; the rows of a curve agree in problem, method, tableau, stages, solver and back end.
  std::ptrdiff_t unusable_curves = 0;
  /// ", 3 too coarse (dmoc 1, tangent 2)", and the same for answers that violate constraints between stages; empty if
  /// there are no such answers.
  std::string no_motions_by_method;
  std::string first_failure;  ///< case and message of the first row that counts as a failure; empty without one
};

/// How the rows of a table ended, by their columns `status` and `branch`.
[[nodiscard]] Outcome outcome_of(const Table& table);

/// Adds the numbers of rows that ended so to the metadata of the run.
void describe(const Outcome& outcome, nlohmann::ordered_json& metadata);

/// The findings of a run: sentences and small tables on standard output, or with --json one JSON object at the end.
/// With --quiet only errors are printed.
class RunSummary {
 public:
  /// Registers --quiet and --json.
  void add_to(CommandLine& line);

  /// Whether the output is for people: neither --quiet nor --json was given.
  [[nodiscard]] bool are_for_people() const noexcept { return !is_quiet_ && !as_json_; }
  /// Whether only errors are printed.
  [[nodiscard]] bool are_quiet() const noexcept { return is_quiet_; }

  /// Adds a sentence.
  void say(const std::string& sentence);
  /// Adds some columns of a table under a name; all columns if `columns` is empty. Columns of the table's key in which
  /// its rows differ are always added, so that no two rows look alike. The output for people has the first of its rows,
  /// with five digits, and the file with all rows.
  void show(const std::string& name, const Table& table, const std::vector<std::string>& columns = {},
            const std::string& file = "", std::size_t most_rows = 12);
  /// Ends with the run's outcome: prints the object if --json was given.
  void end(const nlohmann::ordered_json& outcome) const;

 private:
  bool is_quiet_ = false;
  bool as_json_ = false;
  nlohmann::ordered_json sentences_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json tables_ = nlohmann::ordered_json::object();
};

}  // namespace dmocbench
