#include "methods/solvers/prepared_solve.hpp"

#include <cstddef>
#include <utility>

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
  Solver::check(program_, start, multipliers, barrier_parameter);
  solution_.multipliers_are_estimated = false;
  solution_.kkt_residual.reset();
  solution_.constraint_violation.reset();
  solution_.correction.reset();
  solution_.curvature.reset();
  solution_.evaluations.reset();
  counted_.restart(solver_->seconds_allowed());
  static_cast<void>(solver_->run_and_judge(counted_, *run_, {start, multipliers, barrier_parameter}, confirmation_,
                                           judgement_ == Judgement::confirmed, solution_));
  return solution_;
}

}  // namespace dmocbench
