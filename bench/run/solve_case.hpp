#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/column.hpp"
#include "methods/diagnostics/accuracy.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/diagnostics/violation_between_stages.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/program/solution.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/motions/grid.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/single_shooting.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// A choice that an experiment varies beyond the options of all experiments.
struct Variant {
  std::size_t index = 0;   ///< its number among the experiment's variants
  std::string label = {};  ///< its name in tables and messages; empty if there is no choice
  /// Equal in number and name.
  friend bool operator==(const Variant&, const Variant&) = default;
};

/// One solve: a problem, a method with its tableau, a solver, its derivatives and a grid.
struct Case {
  std::shared_ptr<const Problem> problem;          ///< the problem to solve; shared between cases
  std::string method;                              ///< family of elements, as `make_element` takes it
  std::string tableau = "gauss";                   ///< family of Butcher tableaus, as `make_tableau` takes it
  int stages = 1;                                  ///< s
  std::string solver = {};                         ///< as `make_solver` takes it
  std::string derivatives = "tape";                ///< the back end that the solver sees
  Grid grid = Grid::uniform(1);                    ///< relative node times
  Variant variant = {};                            ///< the experiment's variant; the default if there are no variants
  CostForm form = CostForm::bolza;                 ///< how the cost is stated
  std::optional<double> tolerance = std::nullopt;  ///< of the solve, where an experiment compares several
  /// The problem of which this is an instance with other values, and whose common start it uses; null otherwise.
  std::shared_ptr<const Problem> nominal = nullptr;
  /// Of an instance: all its parameters, in the order of `nominal`, and the names of the parameters that instances
  /// vary.
  Eigen::VectorXd parameters = {};
  std::vector<std::string> varied = {};  ///< names of parameters that differ from case to case
  /// Makes the motion that the case starts from of the one that --start names; null for that one itself.
  std::function<Motion(const Motion&)> start = nullptr;
  /// A text that identifies what the case shares with others (a reference, an answer to compare with): one part of a
  /// run solves all cases with equal texts. Empty if it depends on no other case; common starts and turns are shared
  /// anyway.
  std::string shares = {};
  /// True if the other cases of its curve are measured against its answer: it is solved and measured before them.
  bool is_reference = false;

  /// N.
  [[nodiscard]] std::size_t intervals() const { return grid.intervals(); }
  /// The nonlinear program of this case. Throws `Error` as `Transcription` does.
  [[nodiscard]] std::unique_ptr<Transcription> transcribe() const;
  /// "orbital_transfer dmoc gauss 1 ipopt tape N = 64".
  [[nodiscard]] std::string label() const;
  /// The problem and its settings as part of a file's name: "orbital_transfer_mass_2".
  [[nodiscard]] std::string file_label_of_problem() const;
  /// The case as part of a file's name: "orbital_transfer_mass_2_dmoc_gauss1_64", followed by the derivatives unless
  /// they are by the tape.
  [[nodiscard]] std::string file_label() const;
  /// True if both differ in their grid only: points of one curve.
  [[nodiscard]] bool same_curve(const Case& other) const;
};

/// Wall clock of one solve [s].
struct SolveTimes {
  double seconds = 0.0;                                 ///< wall clock of the solve, s
  double evaluation_seconds = 0.0;                      ///< part of it spent in evaluations, s
  std::optional<double> linear_seconds = std::nullopt;  ///< of solvers that report it
};

struct JudgedAnswer;

/// The result of one solve.
struct SolvedCase {
  Case the_case;                                     ///< the case that was solved
  std::shared_ptr<Transcription> program = nullptr;  ///< null if the case could not start
  /// The program that the solver sees instead by single shooting; null for all other methods. The solution is for
  /// `program`.
  std::shared_ptr<SingleShooting> condensed = nullptr;
  Solution solution = {};                               ///< as the solver left it and our residuals judge it
  Eigen::VectorXd start = {};                           ///< the point it began at; empty if there was none
  std::optional<Trajectory> trajectory = std::nullopt;  ///< empty if there is no point, or a point without momenta
  std::optional<Accuracy> accuracy = std::nullopt;      ///< of a solved case: whether its intervals join
  /// Of a solved case: the violation of constraints between stages.
  std::optional<ViolationBetweenStages> between_stages = std::nullopt;
  /// "same" as the branch of the start or "other"; "unknown" if no common start was found, empty without a search for
  /// one.
  std::string branch = {};
  std::optional<double> setup_seconds = std::nullopt;  ///< of the transcription, s; empty in a batch
  std::vector<SolveTimes> rounds = {};                 ///< of every solve; the times of the solution are their medians
  double tolerance = 0.0;                              ///< of the solver; 0 if the case could not start
  std::optional<int> polish_steps = std::nullopt;      ///< empty if polishing was not requested
  std::optional<double> estimated_error =
      std::nullopt;                 ///< of q, p and cost, relative, where the grid was chosen by it
  double seconds_left = unbounded;  ///< of the solver's limit, for measurements of the answer
  bool is_timed = true;             ///< false in a batch, which solves eight cases side by side without single times
  std::shared_ptr<JudgedAnswer> answer = nullptr;  ///< in a batch: the part shared with cases of the same answer

  /// The program that the solver sees, unless the case could not start.
  [[nodiscard]] const NonlinearProgram& solved_program() const {
    return condensed ? static_cast<const NonlinearProgram&>(*condensed) : *program;
  }
  /// Adds a sentence to the message of the row.
  void note(const std::string& sentence) { solution.message += " " + sentence; }
};

/// Checks of a trajectory that rely on neither solver nor discretisation. Values that cannot be computed stay empty.
struct IndependentChecks {
  std::optional<ReplayError> replay;              ///< the controls integrated on the continuous equations
  std::optional<double> violation_between_nodes;  ///< of bounds and path constraints where no point imposes them
  std::optional<double> free_horizon_residual;    ///< residual of the condition on T; empty for a fixed horizon
  std::optional<double> interval_cost;            ///< of the motion whose intervals are replayed one by one
};

/// An answer that many starts may end at, with everything computed from it.
struct JudgedAnswer {
  SolvedCase judged;                                       ///< the case with its answer and their judgement
  std::optional<IndependentChecks> checks = std::nullopt;  ///< empty until first used
};

/// The columns that begin every experiment's table.
[[nodiscard]] const Columns<SolvedCase>& core_columns();

/// Where a solve starts, and the motion that decides whether its answer is on the wanted branch; without one the branch
/// is left open.
struct Start {
  Motion motion;                                ///< where solves begin
  std::optional<Motion> branch = std::nullopt;  ///< the motion whose branch counts as the same; empty if unknown
  std::string note = {};                        ///< why it is not the requested motion; the row's message ends with it
  /// The motion with its costates, which become start multipliers of solvers that can use them.
  std::optional<Trajectory> with_costates = std::nullopt;
};

/// Transcribes, samples the start, solves `repeats` times (times are medians) and reads the trajectory. A failure is
/// part of the result; its message names the constraint that the point violates most. The solver's limit of time holds
/// for the set-up, the first solve and the judgement of its answer together. The solver sees the case's derivatives;
/// residuals and status use exact derivatives, so that wrong derivatives cannot confirm themselves. Throws
/// `Error` on misuse only. With `polishes` the answer is tightened by Newton steps, which no time counts.
[[nodiscard]] SolvedCase solve_case(const Case& the_case, const Start& start, const Solver& solver, double tolerance,
                                    int repeats, bool polishes = false);

/// Solves from a point, with the multipliers that belong to a trajectory's costates (`sample_multipliers`) where there
/// is one and the solver can use them; if that fails, from the point alone, which the message then states.
[[nodiscard]] Solution solve_from(Transcription& program, const Eigen::VectorXd& start,
                                  const std::optional<Trajectory>& with_costates, const Solver& solver);

/// The steps after a solve: settles the answer (its program, start, solution and tolerance are set), reads the
/// trajectory, judges it by the replay of each interval, and adds notes. `options` are the solver's.
void judge_case(SolvedCase& solved, const Start& start, const SolverOptions& options);

/// The same of a solved case whose answer is known to be this one, which is judged once for all of them.
void take_judgement(SolvedCase& solved, const Start& start, std::shared_ptr<JudgedAnswer> answer);

/// How often a solve like `first` is repeated within one round: short ones for 20 ms, so that an interruption by
/// something else is an outlier.
[[nodiscard]] int solves_per_round(const Solution& first);

/// Keeps the times of several solves, and replaces the times of the answer by their medians.
void set_times(SolvedCase& solved, const std::vector<Solution>& repeats);

/// The seconds of all rounds of a solved case; empty for other cases.
[[nodiscard]] std::vector<double> seconds_of_rounds(const SolvedCase& solved);
/// The columns of these seconds and their quartiles.
[[nodiscard]] Columns<std::vector<double>> round_columns();

/// True if no node is a tenth of the range of q or more away from the motion, at the same relative time. Where q rests
/// and there are first-order states, these are compared.
[[nodiscard]] bool is_on_branch(const Trajectory& trajectory, const Motion& branch);

/// True for solves that ended on the wanted branch, or on any branch if none is wanted (`--start guess`); curves,
/// orders and claims use only these.
[[nodiscard]] bool is_usable(const SolvedCase& solved);
/// True for these and for answers that are not motions (`is_no_motion`), which are still optima of the discrete
/// program.
[[nodiscard]] bool is_discrete_optimum(const SolvedCase& solved);
/// True if the row's status is one of answers that are solved (`is_solved`).
[[nodiscard]] bool has_solved_status(const Row& row);
/// True if the row has an answer that may be compared and drawn: solved, and on the wanted branch.
[[nodiscard]] bool is_usable(const Row& row);
/// True if its control may be compared too: a usable row may be one of `Status::control_not_determined`.
[[nodiscard]] bool has_known_control(const Row& row);

/// Notes on a solved case which results are missing because its time ran out.
void note_stop(SolvedCase& solved, const std::string& left_out);

/// The controls of the case's trajectory replayed; empty without a trajectory or, with the reason in the row's message,
/// if that fails.
[[nodiscard]] std::optional<ReplayError> replay(SolvedCase& solved);

/// Checks a case that has a trajectory. A solved motion on which a formula is not a number becomes a failed evaluation,
/// which the row's message states.
[[nodiscard]] IndependentChecks check_independently(SolvedCase& solved);

/// The column of the distance between the end of a replay and the final state.
template <class Record>
[[nodiscard]] Column<Record> replay_error_column(std::optional<ReplayError> Record::*replay) {
  return {"replay_error", "", "distance between the end of the replay and the final state",
          from(replay, &ReplayError::norm)};
}

/// The columns of all checks.
[[nodiscard]] Columns<IndependentChecks> check_columns();

}  // namespace dmocbench
