#include "bench/run/solve_case.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "methods/adaptive/error_estimate.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/undefined_point.hpp"
#include "methods/error.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "methods/numerics/quantile.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/describe_violation.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/sample_multipliers.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

/// The time that a case may take.
class TimeOfCase {
 public:
  explicit TimeOfCase(const SolverOptions& options) : options_(options) {}

  /// Infinite without a limit; with a limit at least a moment, since 0 would mean no limit.
  [[nodiscard]] double left() const {
    constexpr double moment = 1e-9;
    if (options_.most_seconds <= 0.0) return unbounded;
    return std::max(options_.most_seconds - seconds_since(begin_), moment);
  }
  /// For a part of the work; it ends with the time or an interrupt.
  [[nodiscard]] StopScope scope() const { return {options_.stop_requested, left()}; }
  [[nodiscard]] Status reason() const {
    return options_.stop_requested && options_.stop_requested() ? Status::interrupted : Status::time_limit;
  }

 private:
  const SolverOptions& options_;
  Clock::time_point begin_ = Clock::now();
};

bool takes_multipliers(const Solver& solver) { return solver.name() == "interior_point" || solver.name() == "auto"; }

Solution solve_once(const SolvedCase& solved, const Start& start, const Solver& solver) {
  if (!solved.condensed) return solve_from(*solved.program, solved.start, start.with_costates, solver);
  SingleShooting& program = *solved.condensed;
  return program.expanded(solver.solve(program, program.reduced(solved.start)));
}

/// Solves again from the same start; the times become medians of all.
void repeat(SolvedCase& solved, const Start& start, const Solver& solver, const Solution& first, int repeats) {
  std::vector<Solution> solutions{first};
  try {
    for (int i = 1; i < repeats && is_solved(first.status); ++i) {
      const Solution again = solve_once(solved, start, solver);
      if (!is_solved(again.status)) break;
      solutions.push_back(again);
    }
  } catch (const Stopped&) {  // outside of the solver; there are the times so far
  }
  set_times(solved, solutions);
}

/// Settles an answer that needs it (`settle`). If the solver's derivatives are not exact the answer is judged again by
/// exact ones first; if confirmation failed only with the solver's derivatives, the solver's status is restored.
int settle_exactly(Case the_case, Transcription& program, double tolerance, Solution& solution) {
  if (the_case.derivatives == "tape") return settle(program, tolerance, solution);
  the_case.derivatives = "tape";
  // An inexact derivative at which the solver failed is not to be excused by exact ones.
  if (solution.status == Status::step_failed || solution.status == Status::iteration_limit) return 0;
  if (solution.status == Status::not_confirmed) solution.status = Status::solved;
  const auto exact = the_case.transcribe();
  solution.correction.reset();
  confirm(*exact, tolerance, solution);
  // Exact Newton steps may settle errors that the residuals do not show; a residual left by differences is their
  // result.
  if (is_solved(solution.status) || !solution.correction) return 0;
  return settle(*exact, tolerance, solution);
}

/// Measures violations between stages; a motion that violates its constraints there is not solved.
void judge_between_stages(SolvedCase& solved, const Trajectory& motion) {
  const Problem& problem = *solved.the_case.problem;
  const ViolationBetweenStages found = violation_between_stages(problem, solved.program->traced_problem(), motion);
  solved.between_stages = found;
  if (!is_solved(solved.solution.status) || found.is_motion()) return;
  solved.solution.status = Status::violates_between_stages;
  solved.solution.message = std::string(sentence_of(solved.solution.status)) + found.words(problem, motion);
}

/// A sentence with the estimated error of an answer; empty where there is no estimate.
std::string estimate_in_words(const SolvedCase& solved, const Trajectory& motion) {
  if (!motion.has_costates()) return "";
  try {
    ErrorEstimator estimator(*solved.program);
    const Solution& solution = solved.solution;
    const ErrorEstimate error = estimator.estimate(*solved.program, solution.primal, solution.multipliers, motion);
    return fmt::format(" The estimated relative error of q, p and cost is {:.2g}.", error.relative);
  } catch (const Stopped&) {
    throw;
  } catch (const Error&) {  // a free horizon, active bounds: what it does not cover
    return "";
  }
}

/// What is wrong with the cost of an answer whose intervals lead to the next node.
std::string error_of_cost_in_words(const Accuracy& found) {
  if (found.cost_error > largest_cost_error_of_a_motion) {
    return fmt::format(
        "The quadrature of the program misses {:.2g} of the running cost along the computed trajectory: the cost "
        "varies too fast within the intervals.",
        found.cost_error);
  }
  if (found.cost_miss > largest_cost_miss_of_a_motion) {
    return fmt::format(
        "Integrating each interval alone changes the cost by {:.2g} of its value: the forces vary too fast within the "
        "intervals.",
        found.cost_miss);
  }
  return fmt::format("Controls that vary within the intervals would save about {:.2g} of the cost.",
                     found.control_saving);
}

/// Replays the intervals of a solved case one by one; an answer that is not a motion is too coarse instead of solved,
/// one that does not move as far as it has to is not confirmed.
void judge_accuracy(SolvedCase& solved, const Trajectory& motion) {
  const Accuracy found = accuracy(solved.program->traced_problem(), motion);
  solved.accuracy = found;
  const std::string lost = lost_distance(solved.the_case.problem->bounds(), motion, found);
  if (!lost.empty()) {
    solved.solution.status = Status::not_confirmed;
    solved.solution.message = lost;
    return;
  }
  if (found.is_motion()) return;
  solved.solution.status = Status::too_coarse;
  if (found.relative_jump <= largest_jump_of_a_motion &&
      found.accumulated_jump <= largest_accumulated_jump_of_a_motion) {
    solved.solution.message = fmt::format("{} {}", sentence_of(Status::too_coarse), error_of_cost_in_words(found));
    return;
  }
  if (found.relative_jump <= largest_jump_of_a_motion) {
    solved.solution.message = fmt::format(
        "{} Intervals that are integrated alone miss the next nodes on the same side: by {:.2g} of the range in total, "
        "and by at most {:.2g} in one interval.{}",
        sentence_of(Status::too_coarse), found.accumulated_jump, found.relative_jump,
        estimate_in_words(solved, motion));
    return;
  }
  const Eigen::Index k = found.interval;
  const std::string times = time_in_words(*solved.the_case.problem, motion.node_times[k], motion.node_times[k + 1]);
  const auto undefined = undefined_point(*solved.the_case.problem, motion, k);
  if (undefined || std::isinf(found.relative_jump)) {
    solved.solution.message = fmt::format(
        "The discrete program is solved, but interval {} ({}) does not lead to the next node: {} More intervals do not "
        "help. Keep the formula finite along the trajectory: bound the coordinates away from a singularity, or use a "
        "force as control and limit its power with a path constraint.",
        k, times,
        undefined ? undefined->quantity + " is not a finite number there." : "the formulas are singular there.");
    return;
  }
  solved.solution.message =
      fmt::format("{} Interval {} ({}), integrated alone, misses the next node by {:.2g} of the range.",
                  sentence_of(Status::too_coarse), k, times, found.relative_jump);
}

/// Notes if the scaled cost of the solver differs from 1 by three orders of magnitude.
void note_cost_scale(SolvedCase& solved, double optimum) {
  constexpr double far = 1e3;
  const double cost = std::abs(optimum);
  const double scale = solved.program->cost_scale();
  const double seen = cost * scale;
  if (!is_solved(solved.solution.status) || !std::isnormal(seen) || (seen < far && seen > 1.0 / far)) return;
  solved.note(fmt::format("The optimum is {:.3g}: consider cost_scale = {:g} instead of {:g}.", optimum,
                          std::pow(10.0, -std::round(std::log10(cost))), scale));
}

/// Names the scaled variables of the motion whose size differs from 1 by four orders of magnitude.
void note_variable_sizes(SolvedCase& solved, const Trajectory& motion) {
  constexpr double far = 1e4;
  constexpr double zero = 1e-9;  // smaller values are rounding errors
  if (!is_solved(solved.solution.status)) return;
  std::vector<std::string> found;
  const auto look = [&](const char* prefix, const Eigen::MatrixXd& values, const std::vector<std::string>& names) {
    for (Eigen::Index i = 0; i < values.cols(); ++i) {
      const double size = values.col(i).cwiseAbs().maxCoeff();
      if (size >= far || (size > zero && size <= 1.0 / far)) {
        found.push_back(fmt::format("{}{} ({:.1g})", prefix, names[static_cast<std::size_t>(i)], size));
      }
    }
  };
  const Problem& problem = *solved.the_case.problem;
  look("", motion.q, problem.configuration_names());
  look("the rate of ", motion.v, problem.configuration_names());
  look("", motion.stage_u, problem.control_names());
  if (!found.empty())
    solved.note(fmt::format("Sizes are far from 1: {}. Consider other units.", fmt::join(found, ", ")));
}

/// Judges a solved case as far as the time goes; one whose time is up is not solved.
void judge_in_time(SolvedCase& solved, const Trajectory& motion, const TimeOfCase& time) {
  try {
    const StopScope scope = time.scope();
    judge_accuracy(solved, motion);
    judge_between_stages(solved, motion);
    note_cost_scale(solved, motion.cost);
    note_variable_sizes(solved, motion);
  } catch (const Stopped&) {
    solved.solution.status = time.reason();
    solved.solution.message = fmt::format("{} The last iterate was not checked.", sentence_of(solved.solution.status));
  }
}

/// Notes the branch of the answer, and the reason if it did not begin at the requested start.
void tell_start(SolvedCase& solved, const Start& start) {
  if (start.branch && solved.trajectory) {
    solved.branch = is_on_branch(*solved.trajectory, *start.branch) ? "same" : "other";
  }
  if (start.note.empty()) return;
  solved.branch = "unknown";
  solved.note(start.note);
}

/// Reads the trajectory of an answer, judges it and notes errors.
void read_and_judge(SolvedCase& solved, const Start& start, const TimeOfCase& time) {
  Solution& solution = solved.solution;
  Transcription& program = *solved.program;
  if (solution.primal.allFinite() && solution.primal.size() > 0) {
    try {
      solved.trajectory = read_trajectory(program, solution.primal, solution.multipliers);
    } catch (const Error& error) {
      if (is_solved(solution.status)) solution.status = Status::not_confirmed;  // whether it is a motion is unknown
      solved.note(std::string("The trajectory cannot be read: ") + error.what() + ".");
    }
  }
  if (solved.trajectory && is_solved(solution.status)) judge_in_time(solved, *solved.trajectory, time);
  if (!solved.solution.failed_before.empty()) solved.note(solved.solution.failed_before);
  tell_start(solved, start);
  try {
    const StopScope scope = time.scope();
    if (is_solved(solution.status) && !solution.failed_before.empty()) {
      const std::string flat = describe_flat_constraint(*solved.the_case.problem, program);
      if (!flat.empty()) solved.note(flat);
    }
    const Failure failure = failure_of(*solved.the_case.problem, program, solution, solved.tolerance);
    solved.solution.formula_undefined = failure.formula_undefined;
    if (!failure.words.empty()) solved.note(failure.words);
  } catch (const Stopped&) {
    solved.note("The time limit was reached before the failure could be located.");
  }
}

bool is_wanted_branch(const std::string& branch) { return branch == "same" || branch.empty(); }

}  // namespace

std::unique_ptr<Transcription> Case::transcribe() const {
  return std::make_unique<Transcription>(*problem, *make_element(method), make_tableau(tableau, stages), grid,
                                         derivatives, form);
}

std::string Case::label() const {
  return fmt::format("{} {} {} {} {} {}{}{} N = {}", problem->name(), method, tableau, stages, solver, derivatives,
                     variant.label.empty() ? "" : " ", variant.label, intervals());
}

std::string Case::file_label_of_problem() const {
  std::string label = problem->name() + " " + problem->settings();
  if (label.ends_with(' ')) label.pop_back();
  std::ranges::replace_if(
      label, [](char letter) { return std::string_view(" =/").find(letter) != std::string_view::npos; }, '_');
  return label;
}

std::string Case::file_label() const {
  return fmt::format("{}_{}_{}{}_{}{}", file_label_of_problem(), method, tableau, stages, intervals(),
                     derivatives == "tape" ? "" : "_" + derivatives);
}

bool Case::same_curve(const Case& other) const {
  return problem == other.problem && method == other.method && tableau == other.tableau && stages == other.stages &&
         solver == other.solver && derivatives == other.derivatives && variant == other.variant &&
         tolerance == other.tolerance;
}

int solves_per_round(const Solution& first) {
  constexpr double seconds_of_a_round = 0.02;
  constexpr double most = 400.0;
  return static_cast<int>(std::clamp(seconds_of_a_round / first.seconds, 1.0, most));
}

void set_times(SolvedCase& solved, const std::vector<Solution>& repeats) {
  solved.rounds.clear();
  for (const Solution& solution : repeats) {
    solved.rounds.push_back({solution.seconds, solution.evaluation_seconds, solution.linear_seconds});
  }
  const auto median_of = [&](const auto& time_of) {
    std::vector<double> seconds;
    std::ranges::transform(repeats, std::back_inserter(seconds), time_of);
    return median(std::move(seconds));
  };
  solved.solution.seconds = median_of([](const Solution& s) { return s.seconds; });
  solved.solution.evaluation_seconds = median_of([](const Solution& s) { return s.evaluation_seconds; });
  if (!solved.solution.linear_seconds) return;
  solved.solution.linear_seconds = median_of([](const Solution& s) { return s.linear_seconds.value_or(0.0); });
}

SolvedCase solve_case(const Case& the_case, const Start& start, const Solver& solver, double tolerance, int repeats,
                      bool polishes) {
  SolvedCase result{.the_case = the_case, .tolerance = tolerance};
  const TimeOfCase time(solver.options());
  try {
    const StopScope scope = time.scope();
    const Clock::time_point begin = Clock::now();
    result.program = the_case.transcribe();
    if (family_of(the_case.method).is_condensed) {
      result.condensed = std::make_shared<SingleShooting>(*result.program);
    }
    result.setup_seconds = seconds_since(begin);
  } catch (const Stopped&) {
    result.solution.status = time.reason();
    result.solution.message =
        "The time limit was reached during the set-up: tracing and differentiating the formulas takes longer.";
    return result;
  }
  Transcription& program = *result.program;
  result.start = sample(program, start.motion);
  Solution& solution = result.solution;
  Solution first;
  try {
    const StopScope scope = time.scope();
    first = solve_once(result, start, solver);
    solution = first;
    const int settling_steps = settle_exactly(the_case, program, tolerance, solution);
    if (polishes) result.polish_steps = settling_steps + polish(program, solution);
  } catch (const Stopped&) {  // outside of a solver, as where multipliers of the start are computed
    solution.status = time.reason();
    solution.message = sentence_of(solution.status);
    if (solution.primal.size() == 0) solution.primal = result.start;
  }

  read_and_judge(result, start, time);
  result.seconds_left = time.left();
  const StopScope scope = time.scope();
  repeat(result, start, solver, first, repeats);
  return result;
}

Solution solve_from(Transcription& program, const Eigen::VectorXd& start,
                    const std::optional<Trajectory>& with_costates, const Solver& solver) {
  const TracedProblem& problem = program.traced_problem();
  const bool is_mechanism = problem.constraint_count() > 0 || problem.has_embedding();  // which costates do not start
  if (!with_costates || !takes_multipliers(solver) || is_mechanism) return solver.solve(program, start);
  Solution solution = solver.solve(program, start, sample_multipliers(program, *with_costates));
  if (is_solved(solution.status) || solution.status == Status::interrupted) return solution;
  Solution cold = solver.solve(program, start);
  cold.message +=
      " The solve that started from a trajectory and its costates failed; this one started from the trajectory alone.";
  return cold;
}

void judge_case(SolvedCase& solved, const Start& start, const SolverOptions& options) {
  const TimeOfCase time(options);
  {
    const StopScope scope = time.scope();
    settle(*solved.program, solved.tolerance, solved.solution);
  }
  read_and_judge(solved, start, time);
}

void take_judgement(SolvedCase& solved, const Start& start, std::shared_ptr<JudgedAnswer> answer) {
  const SolvedCase& judged = answer->judged;
  solved.trajectory = judged.trajectory;
  if (solved.trajectory) solved.trajectory->cost = solved.solution.objective / solved.program->cost_scale();
  solved.accuracy = judged.accuracy;
  solved.between_stages = judged.between_stages;
  solved.solution.status = judged.solution.status;
  solved.solution.message = judged.solution.message;
  solved.answer = std::move(answer);
  tell_start(solved, start);
}

bool is_on_branch(const Trajectory& trajectory, const Motion& branch) {
  constexpr double share = 0.1;
  const bool moves = trajectory.y.cols() == 0 || (trajectory.q.rowwise() - trajectory.q.row(0)).any();
  const Eigen::MatrixXd& states = moves ? trajectory.q : trajectory.y;  // of first-order states alone
  const Eigen::VectorXd range = states.colwise().maxCoeff() - states.colwise().minCoeff();
  const double stretch = branch.horizon / trajectory.node_times[trajectory.intervals()];  // same relative time
  double distance = 0.0;
  for (Eigen::Index k = 0; k < trajectory.q.rows(); ++k) {
    const MotionPoint at = branch.at(trajectory.node_times[k] * stretch);
    distance = std::max(distance, (states.row(k).transpose() - (moves ? at.q : at.y)).lpNorm<Eigen::Infinity>());
  }
  return distance < share * range.maxCoeff();
}

bool is_usable(const SolvedCase& solved) {
  return is_solved(solved.solution.status) && is_wanted_branch(solved.branch);
}

bool is_discrete_optimum(const SolvedCase& solved) {
  return is_usable(solved) || (is_no_motion(solved.solution.status) && is_wanted_branch(solved.branch));
}

bool has_solved_status(const Row& row) { return is_solved(status_named(row.text("status"))); }

bool is_usable(const Row& row) { return has_solved_status(row) && is_wanted_branch(row.text("branch")); }

bool has_known_control(const Row& row) { return status_named(row.text("status")) == Status::solved; }

void note_stop(SolvedCase& solved, const std::string& left_out) {
  if (is_solved(solved.solution.status)) solved.note(left_out + ": the time limit was reached.");
}

std::optional<ReplayError> replay(SolvedCase& solved) {
  if (!solved.trajectory) return std::nullopt;
  try {
    return replay_error(*solved.the_case.problem, *solved.trajectory);
  } catch (const Stopped&) {
    note_stop(solved, "The replay is missing");
    return std::nullopt;
  } catch (const Error& error) {
    solved.note(error.what());
    return std::nullopt;
  }
}

namespace {

/// True of answers that a solver found, motions or not.
bool is_judged(Status status) { return is_solved(status) || is_no_motion(status); }

/// The checks of the answer, computed once for all cases that end at it.
IndependentChecks shared_checks(SolvedCase& solved) {
  SolvedCase& judged = solved.answer->judged;
  const std::string before = judged.solution.message;
  std::optional<IndependentChecks>& checks = solved.answer->checks;
  if (!checks) checks = check_independently(judged);
  const std::string& now = judged.solution.message;
  solved.solution.status = judged.solution.status;
  solved.solution.message = now.starts_with(before) ? solved.solution.message + now.substr(before.size()) : now;
  return *checks;
}

}  // namespace

IndependentChecks check_independently(SolvedCase& solved) {
  if (!solved.trajectory) return {};
  if (solved.answer) return shared_checks(solved);
  const Problem& problem = *solved.the_case.problem;
  const Trajectory& trajectory = *solved.trajectory;
  if (const auto undefined = undefined_point(problem, trajectory); undefined && is_judged(solved.solution.status)) {
    solved.solution.status = Status::evaluation_failed;
    solved.solution.formula_undefined = true;
    solved.solution.message = undefined->words();
  }
  IndependentChecks checks{
      .replay = replay(solved), .violation_between_nodes = {}, .free_horizon_residual = {}, .interval_cost = {}};
  try {
    checks.interval_cost = cost_by_intervals(problem, trajectory);
  } catch (const Stopped&) {
    note_stop(solved, "The cost of the intervals is missing");
  } catch (const Error&) {  // an interval cannot be replayed: the motion is judged by its jumps
  }
  if (!solved.between_stages) {
    solved.between_stages = violation_between_stages(problem, solved.program->traced_problem(), trajectory);
  }
  checks.violation_between_nodes = solved.between_stages->largest;
  // Times between the ends that move with T, where costates jump, would add terms.
  if (problem.bounds().horizon.is_free() && problem.bounds().interior.empty() && trajectory.has_costates()) {
    checks.free_horizon_residual = free_horizon_residual(problem, trajectory);
  }
  return checks;
}

}  // namespace dmocbench
