#include "bench/extensions/c_interface/dmocbench.h"

#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "methods/adaptive/adaptive_solve.hpp"
#include "methods/adaptive/error_estimate.hpp"
#include "methods/diagnostics/accuracy.hpp"
#include "methods/diagnostics/violation_between_stages.hpp"
#include "methods/error.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/runtime/environment.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "problems/registry.hpp"

struct dmocbench_problem {
  std::unique_ptr<dmocbench::Problem> problem;
  std::vector<std::string> parameters;
  std::vector<std::string> configurations;
  std::vector<std::string> controls;
};

struct dmocbench_solution {
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  dmocbench::Solution solution;
  std::unique_ptr<dmocbench::Transcription> program;
  std::optional<dmocbench::Trajectory> motion;
  std::string status;
  std::map<std::string, double, std::less<>> numbers;
  std::map<std::string, Table, std::less<>> arrays;
};

namespace dmocbench {

namespace {

thread_local std::string last_error;  // NOLINT(misc-use-internal-linkage): is internal

/// Calls a function of ours; an exception becomes the thread's last error and `failure`.
template <class Value, class Call>
Value guarded(Value failure, const Call& call) noexcept {
  try {
    try {
      return call();
    } catch (const std::bad_alloc&) {
      last_error = "there is not enough memory";
    } catch (const std::exception& error) {
      last_error = error.what();
    } catch (...) {
      last_error = "something unknown went wrong";
    }
  } catch (...) {  // no memory for a sentence
    last_error.clear();
  }
  return failure;
}

template <class Handle>
Handle& required(Handle* handle, const char* what) {
  if (handle == nullptr) throw Error(fmt::format("{} is NULL", what));
  return *handle;
}

/// The string at a number; null past the last.
const char* at(const std::vector<std::string>& names, size_t number) {
  return number < names.size() ? names[number].c_str() : nullptr;
}

const std::vector<std::string>& names_of_problems() {
  static const std::vector<std::string> names = problem_names();
  return names;
}

void keep_numbers(dmocbench_solution& result) {
  const Solution& solution = result.solution;
  const auto keep = [&](const char* name, const auto& value) {
    if (value) result.numbers[name] = static_cast<double>(*value);
  };
  keep("kkt_residual", solution.kkt_residual);
  keep("constraint_violation", solution.constraint_violation);
  keep("iterations", solution.major_iterations);
  result.numbers["seconds"] = solution.seconds;
}

void keep_arrays(dmocbench_solution& result, const Trajectory& motion) {
  const auto keep = [&](const char* name, const auto& values) {
    if (values.size() > 0) result.arrays[name] = values;
  };
  keep("t", motion.node_times);
  keep("q", motion.q);
  keep("v", motion.v);
  keep("p", motion.p);
  keep("psi_q", motion.psi_q);
  keep("psi_p", motion.psi_p);
  keep("stage_t", motion.stage_times);
  keep("stage_q", motion.stage_q);
  keep("stage_v", motion.stage_v);
  keep("stage_u", motion.stage_u);
  result.numbers["cost"] = motion.cost;
}

/// Reads the motion and judges it: its intervals must join, and its constraints hold between stages.
void read_motion(dmocbench_solution& result, const Problem& problem) {
  Solution& solution = result.solution;
  if (solution.primal.size() == 0 || !solution.primal.allFinite()) return;
  result.motion = read_trajectory(*result.program, solution.primal, solution.multipliers);
  keep_arrays(result, *result.motion);
  if (!is_solved(solution.status)) return;
  const Accuracy joined = accuracy(result.program->traced_problem(), *result.motion);
  result.numbers["relative_jump"] = joined.relative_jump;
  const ViolationBetweenStages between =
      violation_between_stages(problem, result.program->traced_problem(), *result.motion);
  result.numbers["violation_between_stages"] = between.largest;
  if (joined.relative_jump > largest_jump_of_a_motion) {
    solution.status = Status::too_coarse;
    solution.message = sentence_of(solution.status);
  } else if (!between.is_motion()) {
    solution.status = Status::violates_between_stages;
    solution.message = std::string(sentence_of(solution.status)) + between.words(*result.motion, 1.0);
  }
}

/// Reads, judges and keeps the results of the handle's program and solution.
std::unique_ptr<dmocbench_solution> told(std::unique_ptr<dmocbench_solution> result, const Problem& problem) {
  read_motion(*result, problem);
  keep_numbers(*result);
  result->numbers["intervals"] = static_cast<double>(result->program->grid().intervals());
  result->numbers["stages"] = static_cast<double>(result->program->tableau().stages());
  result->status = name_of(result->solution.status);
  return result;
}

/// Runs when the library is loaded, as programs do in `main`: answers are then the same in every run.
[[gnu::constructor]] void order_by_one_thread_where_loaded() { order_by_one_thread(); }

std::string method_of(const dmocbench_options& options) {
  std::string method = &required(options.method, "the method");
  if (family_of(method).is_condensed) {
    throw Error(method + " is not offered here; multiple_shooting has the same solutions");
  }
  return method;
}

SolverOptions solver_options_of(const dmocbench_options& options) {
  SolverOptions of_solver;
  of_solver.tolerance = options.tolerance;
  of_solver.most_seconds = options.most_seconds;
  return of_solver;
}

Grid grid_of(const dmocbench_options& options) {
  constexpr std::size_t most = 16'777'216;  // as on the command line
  if (options.intervals <= most) return Grid::uniform(static_cast<long long>(options.intervals));
  throw Error(fmt::format("a grid has at most {} intervals, not {}", most, options.intervals));
}

std::unique_ptr<dmocbench_solution> solved(const Problem& problem, const dmocbench_options& options,
                                           const Motion& start) {
  auto result = std::make_unique<dmocbench_solution>();
  result->program = std::make_unique<Transcription>(
      problem, *make_element(method_of(options)),
      make_tableau(&required(options.tableau, "the tableau"), options.stages), grid_of(options));
  const auto solver = make_solver(&required(options.solver, "the solver"), solver_options_of(options));
  result->solution = solver->solve(*result->program, sample(*result->program, start));
  result->numbers["settling_steps"] = settle(*result->program, options.tolerance, result->solution);
  return told(std::move(result), problem);
}

/// The motion of a solution, to start from. Throws `Error` if it has none, or not of a problem like this one.
Motion motion_of(const dmocbench_solution& solution, const Problem& problem) {
  if (!solution.motion) throw Error("the solution to start from has no motion");
  const bool fits = solution.motion->q.cols() == static_cast<Eigen::Index>(problem.configuration_names().size()) &&
                    solution.motion->stage_u.cols() == static_cast<Eigen::Index>(problem.control_names().size());
  if (!fits) throw Error("the solution to start from belongs to a problem with different numbers of q or u");
  return smooth_motion(*solution.motion);
}

std::unique_ptr<dmocbench_solution> solved_accurately(const Problem& problem, const dmocbench_options& options,
                                                      double accuracy, const std::string& refinement) {
  AdaptiveOptions adaptive;
  adaptive.accuracy = accuracy;
  adaptive.refinement = refinement_named(refinement);
  adaptive.solver = &required(options.solver, "the solver");
  adaptive.solver_options = solver_options_of(options);
  adaptive.validate();
  const AdaptiveTask task{.problem = &problem,
                          .method = method_of(options),
                          .tableau = &required(options.tableau, "the tableau"),
                          .stages = options.stages,
                          .first = grid_of(options),
                          .start = guessed_motion(problem)};
  AdaptiveAnswer answer = solve_adaptively(task, adaptive);
  if (!answer.program) throw Error(answer.message);
  auto result = std::make_unique<dmocbench_solution>();
  result->program = std::move(answer.program);
  result->solution = std::move(answer.solution);
  const bool is_reached = answer.outcome == AdaptiveOutcome::reached;
  if (!is_reached && is_solved(result->solution.status)) result->solution.status = Status::not_confirmed;
  result->solution.message = answer.message;
  if (is_reached) result->numbers["estimated_error"] = answer.estimate.relative;
  return told(std::move(result), problem);
}

double estimated_error(dmocbench_solution& solution) {
  if (!is_solved(solution.solution.status) || !solution.motion) throw Error("the solution is not solved");
  if (!solution.motion->has_costates()) throw Error("the solution has no costates");
  Transcription& program = *solution.program;
  ErrorEstimator estimator(program);
  return estimator.estimate(program, solution.solution.primal, solution.solution.multipliers, *solution.motion)
      .relative;
}

}  // namespace

}  // namespace dmocbench

using dmocbench::guarded;
using dmocbench::required;

const char* dmocbench_version() { return DMOCBENCH_VERSION; }

const char* dmocbench_last_error() { return dmocbench::last_error.c_str(); }

size_t dmocbench_problem_count() {
  return guarded<size_t>(0, [] { return dmocbench::names_of_problems().size(); });
}

const char* dmocbench_problem_name(size_t number) {
  return guarded<const char*>(nullptr, [&] { return dmocbench::at(dmocbench::names_of_problems(), number); });
}

dmocbench_problem* dmocbench_make_problem(const char* name) {
  return guarded<dmocbench_problem*>(nullptr, [&] {
    dmocbench::check_environment();
    auto handle = std::make_unique<dmocbench_problem>();
    handle->problem = dmocbench::make_problem(&required(name, "the name"));
    for (const dmocbench::Parameter& parameter : handle->problem->parameters()) {
      handle->parameters.push_back(parameter.name);
    }
    handle->configurations = handle->problem->configuration_names();
    handle->controls = handle->problem->control_names();
    return handle.release();
  });
}

void dmocbench_free_problem(dmocbench_problem* problem) { delete problem; }

const char* dmocbench_parameter_name(dmocbench_problem* problem, size_t number) {
  return guarded<const char*>(nullptr,
                              [&] { return dmocbench::at(required(problem, "the problem").parameters, number); });
}

int dmocbench_get_parameter(dmocbench_problem* problem, const char* name, double* value) {
  return guarded(1, [&] {
    required(value, "the place of the value") =
        required(problem, "the problem").problem->parameter(&required(name, "the name"));
    return 0;
  });
}

int dmocbench_set_parameter(dmocbench_problem* problem, const char* name, double value) {
  return guarded(1, [&] {
    required(problem, "the problem").problem->set_parameter(&required(name, "the name"), value);
    return 0;
  });
}

const char* dmocbench_configuration_name(dmocbench_problem* problem, size_t number) {
  return guarded<const char*>(nullptr,
                              [&] { return dmocbench::at(required(problem, "the problem").configurations, number); });
}

const char* dmocbench_control_name(dmocbench_problem* problem, size_t number) {
  return guarded<const char*>(nullptr,
                              [&] { return dmocbench::at(required(problem, "the problem").controls, number); });
}

void dmocbench_default_options(dmocbench_options* options) {
  if (options == nullptr) return;
  *options = {.method = "dmoc",
              .tableau = "gauss",
              .stages = 1,
              .intervals = 128,
              .solver = "auto",
              .tolerance = dmocbench::SolverOptions{}.tolerance,
              .most_seconds = 0.0};
}

dmocbench_solution* dmocbench_solve(dmocbench_problem* problem, const dmocbench_options* options) {
  return guarded<dmocbench_solution*>(nullptr, [&] {
    const dmocbench::Problem& solved = *required(problem, "the problem").problem;
    return dmocbench::solved(solved, required(options, "the options"), dmocbench::guessed_motion(solved)).release();
  });
}

dmocbench_solution* dmocbench_solve_from(dmocbench_problem* problem, const dmocbench_options* options,
                                         const dmocbench_solution* start) {
  return guarded<dmocbench_solution*>(nullptr, [&] {
    const dmocbench::Problem& solved = *required(problem, "the problem").problem;
    const dmocbench::Motion motion = dmocbench::motion_of(required(start, "the solution to start from"), solved);
    return dmocbench::solved(solved, required(options, "the options"), motion).release();
  });
}

dmocbench_solution* dmocbench_solve_accurately(dmocbench_problem* problem, const dmocbench_options* options,
                                               double accuracy, const char* refinement) {
  return guarded<dmocbench_solution*>(nullptr, [&] {
    return dmocbench::solved_accurately(*required(problem, "the problem").problem, required(options, "the options"),
                                        accuracy, &required(refinement, "the refinement"))
        .release();
  });
}

void dmocbench_free_solution(dmocbench_solution* solution) { delete solution; }

int dmocbench_is_solved(const dmocbench_solution* solution) {
  return solution != nullptr && is_solved(solution->solution.status) ? 1 : 0;
}

const char* dmocbench_status(const dmocbench_solution* solution) {
  return guarded<const char*>(nullptr, [&] { return required(solution, "the solution").status.c_str(); });
}

const char* dmocbench_message(const dmocbench_solution* solution) {
  return guarded<const char*>(nullptr, [&] { return required(solution, "the solution").solution.message.c_str(); });
}

int dmocbench_estimate_error(dmocbench_solution* solution, double* relative) {
  return guarded(1, [&] {
    double& place = required(relative, "the place of the error");
    place = dmocbench::estimated_error(required(solution, "the solution"));
    solution->numbers["estimated_error"] = place;
    return 0;
  });
}

int dmocbench_number(const dmocbench_solution* solution, const char* name, double* value) {
  return guarded(1, [&] {
    const auto& numbers = required(solution, "the solution").numbers;
    const auto found = numbers.find(&required(name, "the name"));
    if (found == numbers.end()) throw dmocbench::Error(fmt::format("the solution has no number \"{}\"", name));
    required(value, "the place of the value") = found->second;
    return 0;
  });
}

const double* dmocbench_array(const dmocbench_solution* solution, const char* name, size_t* rows, size_t* columns) {
  return guarded<const double*>(nullptr, [&] {
    const auto& arrays = required(solution, "the solution").arrays;
    const auto found = arrays.find(&required(name, "the name"));
    if (found == arrays.end()) throw dmocbench::Error(fmt::format("the solution has no array \"{}\"", name));
    required(rows, "the place of the number of rows") = static_cast<size_t>(found->second.rows());
    required(columns, "the place of the number of columns") = static_cast<size_t>(found->second.cols());
    return found->second.data();
  });
}
