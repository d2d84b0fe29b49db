#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "bench/run/problem_libraries.hpp"
#include "bench/run/solve_case.hpp"

namespace dmocbench {

namespace {

/// A column's getter: a number of the program's.
auto count(std::size_t (*of_program)(const NonlinearProgram&)) {
  return [=](const SolvedCase& solved) {
    return solved.program ? std::optional(of_program(solved.solved_program())) : std::nullopt;
  };
}

/// A number of seconds; empty for cases that could not start and for cases of a batch.
auto seconds(double Solution::*member) {
  return [=](const SolvedCase& solved) {
    return solved.program && solved.is_timed ? std::optional(solved.solution.*member) : std::nullopt;
  };
}

/// A getter of the time that a share of the rounds stays below.
auto quantile_of_rounds(double share) {
  return [share](std::vector<double> seconds) -> std::optional<double> {
    if (seconds.empty()) return {};
    std::ranges::sort(seconds);
    return seconds[static_cast<std::size_t>(std::lround(share * static_cast<double>(seconds.size() - 1)))];
  };
}

std::optional<double> largest_step(const SolvedCase& solved) {
  if (!solved.program) return {};
  return solved.program->steps(solved.start).maxCoeff() * solved.the_case.problem->card().time_unit.factor;
}

double horizon_of(const SolvedCase& solved) {
  const Problem& problem = *solved.the_case.problem;
  const bool has_times = solved.trajectory && solved.trajectory->node_times.size() > 0;
  const double horizon = has_times ? solved.trajectory->node_times.tail<1>()[0] : problem.horizon();
  return horizon * problem.card().time_unit.factor;
}

}  // namespace

const Columns<SolvedCase>& core_columns() {
  using P = const NonlinearProgram&;
  static const Columns<SolvedCase> columns{
      {"problem", "", "name of the problem", [](const SolvedCase& s) { return s.the_case.problem->name(); }, in_key},
      {"method", "", "family of elements", from(&SolvedCase::the_case, &Case::method), in_key},
      {"tableau", "", "family of Butcher tableaus", from(&SolvedCase::the_case, &Case::tableau), in_key},
      {"stages", "", "number of stages s", from(&SolvedCase::the_case, &Case::stages), in_key},
      {"solver", "", "solver (its name for --solver)", from(&SolvedCase::the_case, &Case::solver), in_key},
      {"derivatives", "", "derivative back end of the solver", from(&SolvedCase::the_case, &Case::derivatives), in_key},
      {"intervals", "", "number of intervals N", from(&SolvedCase::the_case, &Case::intervals), in_key},
      {"step", "time", "largest step size of the start, in the problem's unit of time", largest_step},
      {"horizon", "time", "T of the solution, or of the guess, in the problem's unit of time", horizon_of},
      {"library", "", "file of the problem's library; empty for problems of the suite",
       [](const SolvedCase& s) { return library_of(s.the_case.problem->name()); }, in_key},
      {"settings", "", "parameters that differ from their defaults, separated by spaces: mass=2 length=0.5",
       [](const SolvedCase& s) { return s.the_case.problem->settings(); }, in_key},
      {"variables", "", "number of unknowns of the program", count([](P p) { return p.variable_count(); })},
      {"free_variables", "", "number of unknowns that are not fixed by their bounds",
       count([](P p) { return free_variable_count(p); })},
      {"constraints", "", "number of constraints of the program", count([](P p) { return p.constraint_count(); })},
      {"jacobian_nonzeros", "", "nonzeros of the Jacobian", count([](P p) { return p.jacobian_structure().size(); })},
      {"hessian_nonzeros", "", "nonzeros of the Hessian's lower triangle",
       count([](P p) { return p.hessian_structure().size(); })},
      {"status", "", "status of the solve, confirmed by dmocbench's own residuals",
       [](const SolvedCase& s) { return name_of(s.solution.status); }},
      {"branch", "", "same (as the start) or other; unknown if no common start was found; empty if not determined",
       from(&SolvedCase::branch)},
      {"objective", "cost", "cost of the trajectory", from(&SolvedCase::trajectory, &Trajectory::cost)},
      {"tolerance",
       "",
       "tolerance of the solver",
       {[](const SolvedCase& s) { return s.tolerance > 0.0 ? Cell(fmt::format("{:g}", s.tolerance)) : Cell(); },
        FieldType{FieldKind::number, true}}},
      {"kkt_residual", "", "scaled KKT residual", from(&SolvedCase::solution, &Solution::kkt_residual)},
      {"constraint_violation", "", "largest violation of a constraint",
       from(&SolvedCase::solution, &Solution::constraint_violation)},
      {"major_iterations", "", "number of solver iterations", from(&SolvedCase::solution, &Solution::major_iterations)},
      {"minor_iterations", "", "number of iterations of the quadratic programs",
       from(&SolvedCase::solution, &Solution::minor_iterations)},
      {"setup_seconds", "s", "time to build the program (tracing, derivatives, sparsity); empty in a batch",
       from(&SolvedCase::setup_seconds)},
      {"evaluation_seconds", "s", "time that the solve spent in evaluations; empty in a batch",
       seconds(&Solution::evaluation_seconds)},
      {"seconds", "s", "wall-clock time of the solve; empty in a batch, whose cases share their time",
       seconds(&Solution::seconds)},
      {"largest_jump", "",
       "largest distance |(q, v)| between a node and the state integrated over the interval from the previous node",
       from(&SolvedCase::accuracy, &Accuracy::jump)},
      {"relative_jump", "",
       "largest jump of q relative to the range of q, or of v relative to the range of v, whichever is larger",
       from(&SolvedCase::accuracy, &Accuracy::relative_jump)},
      {"jump_interval", "", "interval with the largest relative jump",
       from(&SolvedCase::accuracy, &Accuracy::interval)},
      {"answered_by", "", "solver that found the solution: interior_point or ipopt with auto, \"batch\" in a batch",
       from(&SolvedCase::solution, &Solution::solver)},
      {"message", "", "outcome of the solve, in words", from(&SolvedCase::solution, &Solution::message)},
  };
  return columns;
}

std::vector<double> seconds_of_rounds(const SolvedCase& solved) {
  std::vector<double> seconds;
  if (!is_solved(solved.solution.status)) return seconds;
  std::ranges::transform(solved.rounds, std::back_inserter(seconds), &SolveTimes::seconds);
  return seconds;
}

Columns<std::vector<double>> round_columns() {
  constexpr double quarter = 0.25;
  return {{"seconds_lower_quartile", "s", "lower quartile of the time of the solve over all rounds",
           quantile_of_rounds(quarter)},
          {"seconds_upper_quartile", "s", "upper quartile of the time of the solve over all rounds",
           quantile_of_rounds(1.0 - quarter)},
          {"round_seconds", "s", "wall-clock time of the solve in each round, separated by spaces",
           [](const std::vector<double>& seconds) { return joined_numbers(seconds); }}};
}

Columns<IndependentChecks> check_columns() {
  using Checks = IndependentChecks;
  return {replay_error_column(&Checks::replay),
          {"replay_cost", "cost", "cost of the replayed trajectory", from(&Checks::replay, &ReplayError::cost)},
          {"interval_cost", "cost",
           "cost when every interval is integrated alone; it differs from the objective by the error of the grid",
           &Checks::interval_cost},
          {"violation_between_nodes", "",
           "largest violation of bounds and path constraints between the points at which they are imposed",
           &Checks::violation_between_nodes},
          {"free_horizon_residual", "", "residual of the condition on T; empty for a fixed horizon",
           &Checks::free_horizon_residual}};
}

}  // namespace dmocbench
