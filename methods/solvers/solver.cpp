#include "methods/solvers/solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/confirm.hpp"
#include "methods/solvers/counted_program.hpp"
#include "methods/solvers/least_violation.hpp"

namespace dmocbench {

namespace {

/// " Entry 3 of the start is nan."; empty if the start is finite.
std::string fault_of_start(const Eigen::VectorXd& start) {
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    if (!std::isfinite(start[i])) return fmt::format(" Entry {} of the start is {}.", i, start[i]);
  }
  return {};
}

}  // namespace

void SolverOptions::validate() const {
  if (!(tolerance > 0.0) || !(tolerance < 1.0)) {
    throw Error(fmt::format("the tolerance must lie between 0 and 1, got {}", tolerance));
  }
  if (most_iterations < 1) {
    throw Error(fmt::format("the largest number of iterations must be at least 1, got {}", most_iterations));
  }
  if (!(most_seconds >= 0.0) || std::isinf(most_seconds)) {
    throw Error(fmt::format("the time limit must be a number of seconds, or 0 for none, got {}", most_seconds));
  }
  if (start_barrier_parameter && (!(*start_barrier_parameter > 0.0) || std::isinf(*start_barrier_parameter))) {
    throw Error(fmt::format("the barrier parameter must be a positive number, got {}", *start_barrier_parameter));
  }
}

Solver::Solver(SolverOptions options) : options_(std::move(options)) { options_.validate(); }

Solution Solver::run_of(const Solver& other, CountedProgram& program, const Eigen::VectorXd& start) {
  return other.run(program, start);
}

std::unique_ptr<PreparedRun> Solver::prepare(CountedProgram& /*program*/) const { return nullptr; }

double Solver::seconds_allowed() const {
  constexpr double shortest = 1e-9;  // 0 is no limit
  const double in_scope = std::max(seconds_left(), shortest);
  return options_.most_seconds > 0.0 ? std::min(options_.most_seconds, in_scope) : in_scope;
}

void Solver::complete(CountedProgram& counted, Solution& solution) const {
  solution.seconds = counted.elapsed_seconds();
  solution.evaluation_seconds = counted.evaluation_seconds();
  if (counted.counts().total() > 0) solution.evaluations = counted.counts();
  judge_infeasibility(counted, options_, solution);
}

Solution Solver::solve(NonlinearProgram& program, const Eigen::VectorXd& start) const {
  if (static_cast<std::size_t>(start.size()) != program.variable_count()) {
    throw Error(
        fmt::format("the start has {} entries, the program {} variables", start.size(), program.variable_count()));
  }
  CountedProgram counted(program, seconds_allowed());
  Solution solution = run(counted, start);
  if (solution.solver.empty()) solution.solver = name();
  complete(counted, solution);
  confirm(program, options_.tolerance, solution);
  if (solution.message.empty()) solution.message = sentence_of(solution.status);
  if (solution.status == Status::evaluation_failed) solution.message += fault_of_start(start);
  return solution;
}

}  // namespace dmocbench
