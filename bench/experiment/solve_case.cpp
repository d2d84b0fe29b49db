#include "bench/experiment/solve_case.hpp"

#include <algorithm>
#include <chrono>

#include "methods/error.hpp"
#include "methods/solvers/confirm.hpp"
#include "methods/solvers/polish.hpp"
#include "methods/transcription/describe_violation.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// Solves several times from the same start; the answer is the first one's, the times are medians.
Solution solve_repeatedly(Transcription& transcription, const Eigen::VectorXd& start, const Solver& solver,
                          int repeats) {
  Solution solution = solver.solve(transcription, start);
  std::vector<double> seconds{solution.seconds};
  std::vector<double> evaluation_seconds{solution.evaluation_seconds};
  std::vector<double> linear_seconds{solution.linear_seconds.value_or(0.0)};
  for (int i = 1; i < repeats && is_solved(solution.status); ++i) {
    const Solution again = solver.solve(transcription, start);
    if (again.status == Status::interrupted) break;
    seconds.push_back(again.seconds);
    evaluation_seconds.push_back(again.evaluation_seconds);
    linear_seconds.push_back(again.linear_seconds.value_or(0.0));
  }
  solution.seconds = median(seconds);
  solution.evaluation_seconds = median(evaluation_seconds);
  if (solution.linear_seconds) solution.linear_seconds = median(linear_seconds);
  return solution;
}

/// Judges a solution again by exact derivatives. The solver's own word counts once more where its derivatives denied
/// it.
void judge_exactly(const Case& what, double tolerance, Solution& solution) {
  Transcription exact(*what.problem, *make_element(what.method), make_tableau(what.tableau, what.stages), what.grid,
                      "tape", what.form);
  if (solution.status == Status::not_confirmed) solution.status = Status::solved;
  confirm(exact, tolerance, solution);
}

/// "same" if no node is farther from the wanted motion than a tenth of the range of q, else "other".
const char* branch_of(const Trajectory& trajectory, const Motion& wanted) {
  constexpr double share = 0.1;
  const Eigen::VectorXd range = trajectory.q.colwise().maxCoeff() - trajectory.q.colwise().minCoeff();
  const double stretch = wanted.horizon / trajectory.node_times[trajectory.intervals()];  // same relative time
  double distance = 0.0;
  for (Eigen::Index k = 0; k < trajectory.q.rows(); ++k) {
    const Eigen::VectorXd difference =
        trajectory.q.row(k).transpose() - wanted.at(trajectory.node_times[k] * stretch).q;
    distance = std::max(distance, difference.lpNorm<Eigen::Infinity>());
  }
  return distance < share * range.maxCoeff() ? "same" : "other";
}

/// What is known of a row without solving, and how the solve ended.
void describe(SolvedCase& solved) {
  Row& row = solved.row;
  row.set("problem", solved.what.problem->name());
  row.set("method", solved.what.method);
  row.set("tableau", solved.what.tableau);
  row.set("stages", static_cast<long long>(solved.what.stages));
  row.set("solver", solved.what.solver);
  row.set("derivatives", solved.what.derivatives);
  row.set("intervals", static_cast<long long>(solved.what.intervals()));
  row.set("status", std::string(name_of(solved.solution.status)));
  row.set("message", solved.solution.message);
}

}  // namespace

const std::vector<std::string>& core_columns() {
  static const std::vector<std::string> columns = {
      "problem",          "method",
      "tableau",          "stages",
      "solver",           "derivatives",
      "intervals",        "step",
      "variables",        "free_variables",
      "constraints",      "jacobian_nonzeros",
      "hessian_nonzeros", "status",
      "branch",           "objective",
      "kkt_residual",     "constraint_violation",
      "major_iterations", "minor_iterations",
      "setup_seconds",    "evaluation_seconds",
      "seconds",          "message",
  };
  return columns;
}

SolvedCase unsolved_case(const Case& what, const std::string& reason) {
  SolvedCase result{.what = what, .solution = {}, .start = {}, .trajectory = {}, .row = {}};
  result.solution.message = reason;
  describe(result);
  return result;
}

SolvedCase solve_case(const Case& what, const Start& start, const SolverOptions& options, int repeats, bool polishes,
                      const SolverMaker& make) {
  SolvedCase result{.what = what, .solution = {}, .start = {}, .trajectory = {}, .row = {}};
  const auto setup_start = Clock::now();
  Transcription transcription(*what.problem, *make_element(what.method), make_tableau(what.tableau, what.stages),
                              what.grid, what.derivatives, what.form);
  const double setup_seconds = seconds_since(setup_start);
  result.start = sample(transcription, start.motion);
  const auto solver = make ? make(what, options) : make_solver(what.solver, options);
  result.solution = solve_repeatedly(transcription, result.start, *solver, repeats);
  Solution& solution = result.solution;
  if (what.derivatives != "tape") judge_exactly(what, options.tolerance, solution);
  if (polishes) result.row.set("polish_steps", static_cast<long long>(polish(transcription, solution)));

  if (solution.primal.allFinite() && solution.primal.size() > 0) {
    try {
      result.trajectory = read_trajectory(transcription, solution.primal, solution.multipliers);
    } catch (const Error& error) {
      solution.message += std::string(" Its trajectory cannot be read: ") + error.what() + ".";
    }
  }

  const std::string missed = describe_violation(*what.problem, transcription, solution, options.tolerance);
  if (!missed.empty()) solution.message += " " + missed;
  describe(result);
  Row& row = result.row;
  row.set("step", transcription.steps(result.start).maxCoeff() * what.problem->time_unit().factor);
  row.set("variables", static_cast<long long>(transcription.variable_count()));
  row.set("free_variables", static_cast<long long>(free_variable_count(transcription)));
  row.set("constraints", static_cast<long long>(transcription.constraint_count()));
  row.set("jacobian_nonzeros", static_cast<long long>(transcription.jacobian_structure().size()));
  row.set("hessian_nonzeros", static_cast<long long>(transcription.hessian_structure().size()));
  row.set("kkt_residual", solution.kkt_residual);
  row.set("constraint_violation", solution.constraint_violation);
  row.set("major_iterations", solution.major_iterations);
  row.set("minor_iterations", solution.minor_iterations);
  row.set("setup_seconds", setup_seconds);
  row.set("evaluation_seconds", solution.evaluation_seconds);
  row.set("seconds", solution.seconds);
  if (result.trajectory) {
    if (start.branch) row.set("branch", branch_of(*result.trajectory, *start.branch));
    row.set("objective", result.trajectory->cost);
  }
  return result;
}

bool is_usable(const Row& row) { return row.text("status") == "solved" && row.text("branch") == "same"; }

}  // namespace dmocbench
