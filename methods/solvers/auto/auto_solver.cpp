#include "methods/solvers/auto/auto_solver.hpp"

#include "methods/solvers/counted_program.hpp"

namespace dmocbench {

namespace {

/// The options with those of the passed on that belong to `interior_point`, or those that do not.
SolverOptions options_of(SolverOptions options, bool of_interior_point) {
  std::erase_if(options.passed_on,
                [&](const auto& option) { return (option.first == "factorisation") != of_interior_point; });
  return options;
}

/// Where another method may do better.
bool leaves_hope(Status status) {
  switch (status) {
    case Status::solved:
    case Status::time_limit:
    case Status::interrupted:
    case Status::out_of_memory:
      return false;
    default:
      return true;
  }
}

}  // namespace

AutoSolver::AutoSolver(const SolverOptions& options)
    : Solver(options), first_(options_of(options, true)), second_(options_of(options, false)) {}

std::string AutoSolver::description() const { return "interior_point and, where that fails, ipopt from its point"; }

Solution AutoSolver::run(CountedProgram& program, const Eigen::VectorXd& start) const {
  Solution first = run_of(first_, program, start);
  first.solver = first_.name();
  if (!leaves_hope(first.status)) return first;
  const bool has_point = first.primal.size() == start.size() && first.primal.allFinite();
  Solution second = run_of(second_, program, has_point ? first.primal : start);
  second.solver = second_.name();
  second.major_iterations = first.major_iterations.value_or(0) + second.major_iterations.value_or(0);
  return second;
}

}  // namespace dmocbench
