#include "methods/solvers/prepared_solve.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "methods/error.hpp"

namespace dmocbench {

PreparedSolve::PreparedSolve(NonlinearProgram& program, std::string_view solver, const SolverOptions& options,
                             Judgement judgement)
    : PreparedSolve(program, make_solver(solver, options), judgement) {}

PreparedSolve::PreparedSolve(NonlinearProgram& program, std::unique_ptr<Solver> solver, Judgement judgement)
    : program_(program),
      solver_(std::move(solver)),
      judgement_(judgement),
      counted_(program),
      run_(solver_->prepare(counted_)),
      confirmation_(program) {
  constexpr std::size_t longest_message = 512;
  solution_.message.reserve(longest_message);
  solution_.solver = solver_->name();
}

const Solution& PreparedSolve::solve(const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers,
                                     std::optional<double> barrier_parameter) {
  const auto require = [](Eigen::Index given, std::size_t wanted, const char* what, const char* of_program) {
    if (static_cast<std::size_t>(given) == wanted) return;
    throw Error(fmt::format("{} {} entries, the program {} {}", what, given, wanted, of_program));
  };
  const Eigen::VectorXd& from = multipliers.size() > 0 ? multipliers : solver_->options().start_multipliers;
  require(start.size(), program_.variable_count(), "the start has", "variables");
  if (from.size() > 0) require(from.size(), program_.constraint_count(), "the multipliers have", "constraints");
  const std::optional<double> mu = barrier_parameter ? barrier_parameter : solver_->options().start_barrier_parameter;
  if (mu && (!(*mu > 0.0) || std::isinf(*mu))) {
    throw Error(fmt::format("the barrier parameter must be a positive number, got {}", *mu));
  }
  if (!run_) {
    solve_anew(start, from, mu);
    return solution_;
  }
  solution_.multipliers_are_estimated = false;
  solution_.kkt_residual.reset();
  solution_.constraint_violation.reset();
  solution_.correction.reset();
  solution_.evaluations.reset();
  counted_.restart(solver_->seconds_allowed());
  run_->run(start, from, mu, solution_);
  solver_->complete(counted_, solution_);
  confirmation_.judge(solver_->options().tolerance, solution_, judgement_ == Judgement::confirmed);
  if (solution_.message.empty()) solution_.message = sentence_of(solution_.status);
  return solution_;
}

/// By a solver without memory.
void PreparedSolve::solve_anew(const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers,
                               std::optional<double> barrier_parameter) {
  if (multipliers.size() == 0 && !barrier_parameter) {
    solution_ = solver_->solve(program_, start);
    return;
  }
  SolverOptions options = solver_->options();
  options.start_multipliers = multipliers;
  options.start_barrier_parameter = barrier_parameter;
  solution_ = make_solver(solver_->name(), options)->solve(program_, start);
}

}  // namespace dmocbench
