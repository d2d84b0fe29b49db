#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/experiment/command_line.hpp"
#include "bench/experiment/options.hpp"
#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

/// An experiment: many solves, a row for each, and what its author makes of them.
///
/// `run_experiment` reads the command line, solves case after case and keeps the table on disk up to date; an
/// experiment adds its own columns and files.
class Experiment {
 public:
  virtual ~Experiment() = default;
  Experiment(const Experiment&) = delete;
  Experiment& operator=(const Experiment&) = delete;
  Experiment(Experiment&&) = delete;
  Experiment& operator=(Experiment&&) = delete;

  /// The binary's name; the table's, unless the user gives another.
  [[nodiscard]] virtual std::string name() const = 0;
  /// What `--help` says.
  [[nodiscard]] virtual std::string description() const = 0;
  [[nodiscard]] virtual std::string default_intervals() const = 0;
  /// Changes what else is chosen unless the user chooses.
  virtual void set_defaults(ExperimentOptions& /*options*/) const {}
  /// Columns behind the core ones.
  [[nodiscard]] virtual std::vector<std::string> own_columns() const = 0;

  /// Options behind the common ones.
  virtual void add_options(CommandLine& /*line*/) {}
  /// The cases that are made of one curve (cases that differ in their grid only), curve after curve; by default itself.
  [[nodiscard]] virtual std::vector<Case> variants(const std::vector<Case>& curve) const { return curve; }
  /// The solver's options for one case; by default those of the command line.
  [[nodiscard]] virtual SolverOptions options_for(const Case& /*what*/, SolverOptions common) { return common; }
  /// The motion that a case starts from; by default the one that --start names.
  [[nodiscard]] virtual Motion start_for(const Case& /*what*/, Motion chosen) const { return chosen; }
  /// Whether rows tell their branch; to know it takes the solves of a common start.
  [[nodiscard]] virtual bool tells_branches() const { return true; }
  /// Whether problems may be worked on at the same time (--jobs): rows of one need nothing of another's.
  [[nodiscard]] virtual bool problems_are_independent() const { return false; }
  /// Whether solved cases are tightened by Newton steps (polish.hpp).
  [[nodiscard]] virtual bool polishes() const { return false; }
  /// Looks at the cases before anything is solved or written. Throws `Error` if they do not fit.
  virtual void check(const std::vector<Case>& /*cases*/) {}
  /// Called when the output folder is there and before anything is solved.
  virtual void prepare(const std::filesystem::path& /*folder*/) {}
  /// The order in which the cases of one curve (intervals ascending) are solved; the default is ascending.
  [[nodiscard]] virtual std::vector<std::size_t> solving_order(const std::vector<Case>& curve) const;
  /// Fills in the own columns of a solved case. Called in the order of solving.
  virtual void complete(SolvedCase& solved) = 0;
  /// Writes further files when all rows are there; may add to the metadata. `prefix` is the folder and name of the
  /// table.
  virtual void finish(const Table& /*table*/, const std::filesystem::path& /*prefix*/,
                      nlohmann::ordered_json& /*metadata*/) {}

 protected:
  Experiment() = default;
};

/// Runs an experiment from the command line and returns the exit code: 0 if all is solved, 1 if a solve failed (it
/// keeps its row), 2 on bad input or if a file cannot be written (one line on standard error), 130 if interrupted
/// (finished rows are kept).
int run_experiment(Experiment& experiment, int argc, char** argv);

}  // namespace dmocbench
