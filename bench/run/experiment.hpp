#pragma once

#include <any>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/run/case_list.hpp"
#include "bench/run/options.hpp"
#include "bench/run/run_summary.hpp"

namespace dmocbench {

class IndirectReference;
class KeptRows;

/// Which rows state whether their answer is on the branch of their start (the column `branch`).
enum class BranchReport : std::uint8_t {
  of_chosen_start,  ///< those that start from the common start or from a file
  of_any_start,     ///< also those that start at the guess: methods are compared by rows of one branch, and a common
                    ///< start is looked for to know it
  none,             ///< no row
};

/// The use of an experiment's rows.
enum class RowUse : std::uint8_t {
  curves,   ///< they are compared: the exit code is 1 if a curve has no usable row. `finish` needs only the rows and
            ///< `indirect`, so that --part is offered, and an interrupted run is resumed
  motions,  ///< each is a motion that the user wants: the exit code is 1 if one is not solved or no motion
            ///< (`is_no_motion`). A start's costates become start multipliers, and `finish` is called after an
            ///< interrupt too, if the first row is there
};

/// The properties of an experiment that do not depend on its cases.
struct ExperimentCard {
  std::string name;           ///< of the binary, and of the table unless the user gives another
  std::string description;    ///< in `--help`
  ExperimentOptions options;  ///< the defaults; then the choice of the user
  /// The endings that `finish` appends to the table's name, as in "_slopes.csv"; known when `cases` has returned. Files
  /// of an earlier run are removed when the first row is written, so that old and new files are never mixed.
  std::vector<std::string> further_files = {};
  RowUse rows = RowUse::curves;                           ///< the use of the rows
  BranchReport branches = BranchReport::of_chosen_start;  ///< which rows state their branch
  bool problems_are_independent = false;  ///< rows of one problem do not depend on other problems: --jobs is offered
  bool takes_turns = false;  ///< all solves of a problem and grid are repeated in turn (--repeats rounds), so that
                             ///< other load of the machine slows all of them alike
  bool compares_tolerances = false;  ///< several tolerances make several cases: --tolerances is offered
  bool polishes = false;             ///< solved cases are tightened by Newton steps (polish.hpp)
  bool takes_batches = false;        ///< cases of one program may be solved side by side, without times and without
                                     ///< `solve`: --batch is offered
  std::string example = {};          ///< options of a call that `--help` shows; by default a problem and its grids
};

/// A solve to be carried out.
struct SolveTask {
  Case the_case;               ///< the case to be solved
  Start start;                 ///< where the solve begins
  SolverOptions options;       ///< from the command line, with the tolerance of the case
  NamedOptions named_options;  ///< options passed to the solver by name
  int repeats = 1;             ///< solves; times are their medians
  bool polishes = false;       ///< as in the card

  /// Solves the case as it stands here (`solve_case`).
  [[nodiscard]] SolvedCase by(const Solver& solver) const;
};

/// The output of an experiment besides its rows.
struct FurtherOutput {
  std::filesystem::path prefix;                           ///< folder and name of the table
  nlohmann::ordered_json& metadata;                       ///< of the run
  const KeptRows& kept;                                   ///< rows of earlier runs about other problems
  RunSummary& summary;                                    ///< printed at the end
  std::vector<std::filesystem::path> named_by_user = {};  ///< tables in that folder whose names are the user's

  /// Writes one of the card's further files, and the meanings of its columns to the metadata. Rows of a problem get its
  /// library and settings, and follow the rows of other problems that earlier runs have left in the file. Throws
  /// `Error` as `write_file`.
  void write(const std::string& suffix, const Table& table);
};

/// A solved case with its measurements: an object of a type that the experiment chooses.
struct MeasuredCase {
  SolvedCase& solved;  ///< as it was solved, and noted since
  std::any measured;   ///< the measurements that the experiment's columns read
};

/// The columns that an experiment adds to the core ones, and how their values are found.
struct OwnColumns {
  Columns<MeasuredCase> columns = {};                    ///< after the core columns
  std::any not_measured = {};                            ///< the measurements of a case before `measure`
  std::function<void(MeasuredCase&)> measure = nullptr;  ///< null if there are no measurements
};

/// An experiment: many solves, a row for each, and files made of all rows.
///
/// `run_experiment` reads the command line, makes the cases, solves them one by one, measures each answer, stores its
/// row and writes the table at the end. An experiment whose columns only read solved cases is an object of this class;
/// one that measures something of them derives from `ExperimentOf`.
class Experiment {
 public:
  /// An experiment with these columns after the core columns.
  explicit Experiment(ExperimentCard card, Columns<SolvedCase> columns = {});
  virtual ~Experiment() = default;
  Experiment(const Experiment&) = delete;
  Experiment& operator=(const Experiment&) = delete;

  /// The description of the experiment.
  [[nodiscard]] const ExperimentCard& card() const noexcept { return card_; }
  /// Its options, as the command line has set them.
  [[nodiscard]] ExperimentOptions& options() noexcept { return card_.options; }
  /// The indirect solutions that it compares with, or null. The store of a run keeps them, too.
  [[nodiscard]] IndirectReference* indirect() const noexcept { return indirect_.get(); }

  /// Options after the common ones.
  virtual void add_options(CommandLine& /*line*/) {}
  /// The cases of the run in the order of rows, made of those that the common options name; by default these. Called
  /// once, when the command line is read and before anything is written. Throws `Error` if they do not fit.
  [[nodiscard]] virtual std::vector<Case> cases(const std::vector<Case>& chosen) { return chosen; }
  /// Solves a case; by default by the solver of its name. Throws `NoStart` with the status for its row where there is
  /// nothing to solve.
  [[nodiscard]] virtual SolvedCase solve(SolveTask task);
  /// The columns after the core columns; by default the constructor's.
  [[nodiscard]] virtual OwnColumns own_columns();
  /// Writes further files when all rows are there, or as the card specifies; may add to the metadata, and to the rows
  /// values that depend on other rows.
  virtual void finish(Table& /*rows*/, FurtherOutput& /*output*/) {}

 protected:
  /// The description of the experiment.
  ExperimentCard card_;
  /// Set by `cases` where rows are compared with indirect solutions.
  std::shared_ptr<IndirectReference> indirect_;

 private:
  Columns<SolvedCase> columns_;
};

/// An experiment that measures a `Measured` for each solved case; its columns are the columns of that record. A case
/// that could not be measured has the default record.
template <class Measured>
class ExperimentOf : public Experiment {
 public:
  /// An experiment of this card.
  explicit ExperimentOf(ExperimentCard card) : Experiment(std::move(card)) {}

  /// Columns after the core columns. Called for `--help` and, when `cases` has returned, for the table.
  [[nodiscard]] virtual Columns<Measured> columns() const = 0;
  /// Measures a case, solved or not, in the order of solving: cases in their order, references of curves first. Values
  /// filled in before it fails, or before time or memory run out, go to the row. May add to the message of the row; the
  /// sentence of an `Error` that it throws is added, too.
  virtual void measure(SolvedCase& solved, Measured& measured) = 0;

  /// The columns of the record.
  [[nodiscard]] OwnColumns own_columns() final {
    const auto record = [](const MeasuredCase& one) -> const Measured& {
      return std::any_cast<const Measured&>(one.measured);
    };
    return {.columns = columns_through<MeasuredCase>(record, columns()),
            .not_measured = Measured{},
            .measure = [this](MeasuredCase& one) { measure(one.solved, std::any_cast<Measured&>(one.measured)); }};
  }
};

/// Runs an experiment from the command line and returns the exit code: 0 if every curve (the rows of one problem,
/// method, tableau, number of stages, solver and back end) has a usable row; of an experiment that `wants_motions`, if
/// every row is a motion; else 1. It is 2 on bad input or if a file cannot be written (one line on standard error), 130
/// if interrupted. One part of a run (--part) is 0 as soon as all of its rows are stored. The table of an earlier run
/// keeps its rows of other problems, libraries and settings; a table with other columns is rejected. An earlier run of
/// the same name is left untouched until the run ends or is interrupted; while its files are written, the metadata
/// contain `"complete": false`. Two runs never write one table at a time.
///
/// A run that is interrupted or killed keeps its finished rows in NAME.rows next to its table (`RowStore`); the same
/// command resumes it if program, libraries, options and cases are the same (`RunPlan::identity`) and --fresh is not
/// given.
int run_experiment(Experiment&& experiment, int argc, char** argv);

}  // namespace dmocbench
