#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/run/case_list.hpp"
#include "bench/run/json_place.hpp"
#include "bench/run/options.hpp"

namespace dmocbench {

/// The properties of an experiment that do not depend on its cases.
struct ExperimentCard {
  std::string name;                        ///< of the binary, and of the table unless the user gives another
  std::string description;                 ///< in `--help`
  ExperimentOptions options;               ///< the defaults; then the choice of the user
  bool tells_branches = true;              ///< rows tell whether they are on the branch of their start
  bool tells_branches_from_guess = false;  ///< also where solves start at the guess: methods are compared by rows of
                                           ///< one branch, which needs a common start
  bool problems_are_independent = false;   ///< rows of one problem need nothing of another's: --jobs is offered
  bool takes_turns = false;  ///< all solves of a problem and grid are repeated in turn (--repeats rounds), so that
                             ///< other load of the machine slows all of them alike
  bool compares_tolerances = false;   ///< several tolerances make several cases: --tolerances is offered
  bool polishes = false;              ///< solved cases are tightened by Newton steps (polish.hpp)
  bool takes_costates = false;        ///< a start from a file brings its costates as start multipliers
  bool cases_stand_alone = false;     ///< an error in the first case is no reason to give up the others
  bool takes_batches = false;         ///< cases of one program may be solved side by side, without times: --batch is
                                      ///< offered; `solver_for`, `solved_first` and `solved_once` are those above
  bool finishes_interrupted = false;  ///< `finish` is called too where a stop was asked for behind the first row
  bool takes_parts = true;            ///< --part is offered: `finish` needs nothing of solves but rows and findings
};

/// An experiment: many solves, a row for each, and files made of all rows.
///
/// `run_experiment` reads the command line, solves case after case and keeps the table on disk up to date; an
/// experiment adds its own columns and files.
class Experiment {
 public:
  /// An experiment of this name, with these options.
  explicit Experiment(ExperimentCard card) : card_(std::move(card)) { card_.options.name = card_.name; }
  virtual ~Experiment() = default;
  Experiment(const Experiment&) = delete;
  Experiment& operator=(const Experiment&) = delete;
  Experiment(Experiment&&) = delete;
  Experiment& operator=(Experiment&&) = delete;

  /// What the experiment says of itself.
  [[nodiscard]] const ExperimentCard& card() const noexcept { return card_; }
  /// Its options, as the command line has set them.
  [[nodiscard]] ExperimentOptions& options() noexcept { return card_.options; }

  /// Columns behind the core ones; they are read when `complete` has returned.
  [[nodiscard]] virtual Columns<SolvedCase> columns() const { return {}; }
  /// Options behind the common ones.
  virtual void add_options(CommandLine& /*line*/) {}
  /// The cases that are made of one curve (cases that differ in their grid only), curve after curve; by default itself.
  [[nodiscard]] virtual std::vector<Case> variants(const std::vector<Case>& curve) const { return curve; }
  /// The solver of a case, with the options of the command line; by default the one of its name.
  [[nodiscard]] virtual std::unique_ptr<Solver> solver_for(const Case& the_case, SolverOptions options);
  /// The motion that a case starts from; by default the one that --start names.
  [[nodiscard]] virtual Motion start_for(const Case& /*the_case*/, Motion chosen) const { return chosen; }
  /// May give a case another grid, number of stages and start, and lower the time and tolerance of its solve; by
  /// default nothing. Throws `NoStart` where there is nothing to solve then.
  virtual void adapt(Case& /*the_case*/, Start& /*start*/, SolverOptions& /*options*/) {}
  /// Looks at the cases before anything is solved or written. Throws `Error` if they do not fit.
  virtual void check(const std::vector<Case>& /*cases*/) {}
  /// The case of one curve (intervals ascending) that is solved first, before the others in ascending order.
  [[nodiscard]] virtual std::size_t solved_first(const std::vector<Case>& /*curve*/) const { return 0; }
  /// Told of every case behind its first solve, before the next one is solved.
  virtual void solved_once(const SolvedCase& /*solved*/) {}
  /// What a case shares with others, in words: those of equal words need something of each other (a reference, an
  /// answer to compare with) and are solved by one part of a run; empty if it needs nothing. A common start, and turns,
  /// are shared anyway.
  [[nodiscard]] virtual std::string shared_by(const Case& /*the_case*/) const { return {}; }
  /// Measures the values of the own columns for a solved case. Called in the order of solving.
  virtual void complete(SolvedCase& /*solved*/) {}
  /// What `finish` puts behind the table's name, as in "_slopes.csv"; asked for after `check`. Those of an earlier run
  /// are removed when the first row is written, so that old and new never stand beside each other.
  [[nodiscard]] virtual std::vector<std::string> further_files() const { return {}; }
  /// Tables of the run's folder that the command line names and `complete` writes; the metadata tell of them too.
  [[nodiscard]] virtual std::vector<std::filesystem::path> named_files() const { return {}; }
  /// The rows with what they tell of each other, when all are there; by default as they are.
  [[nodiscard]] virtual Table compared(const Table& table) const { return table; }
  /// What `finish` needs of the cases that were solved, besides their rows: a part keeps it in its file.
  [[nodiscard]] virtual nlohmann::ordered_json findings() const;
  /// Takes in what a part has found, part after part, before `finish` is called of all.
  virtual void add_findings(const JsonPlace& /*findings*/) {}
  /// Writes further files when all rows are there, or as the card says; may add to the metadata. `prefix` is the folder
  /// and name of the table.
  virtual void finish(const Table& /*table*/, const std::filesystem::path& /*prefix*/,
                      nlohmann::ordered_json& /*metadata*/) {}

 protected:
  /// What the experiment says of itself.
  ExperimentCard card_;
};

/// Runs an experiment from the command line and returns the exit code: 0 if all is solved, 1 if a solve failed (it
/// keeps its row), 2 on bad input or if a file cannot be written (one line on standard error), 130 if interrupted
/// (finished rows are kept). One part of a run (--part) is 0 as soon as its file is there, which has no rows of an
/// interrupted one. Nothing of an earlier run of that name is touched before the first row is there; from then
/// on until all files are written, the metadata say `"complete": false`. Two runs never write one table at a time.
int run_experiment(Experiment&& experiment, int argc, char** argv);

}  // namespace dmocbench
