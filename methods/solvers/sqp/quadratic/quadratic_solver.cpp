#include "methods/solvers/sqp/quadratic/quadratic_solver.hpp"

#include <utility>

#include "methods/solvers/sqp/quadratic/basis.hpp"

namespace dmocbench::sqp {

namespace {

WorkingSet slack_start(const QuadraticProgram& program) {
  return WorkingSet::slack_start(program.variable_count(), program.row_count());
}

/// The same free columns, with a well-conditioned basis among them.
WorkingSet warm_start(const QuadraticProgram& program, const WorkingSet& sets) {
  BasisChoice choice = choose_basis(program, sets.basics(), sets.superbasics());
  return {program.column_count(), std::move(choice.basics), std::move(choice.others)};
}

bool leaves_variable_outside(const Iterate& iterate) {
  for (Eigen::Index j = 0; j < iterate.program().variable_count(); ++j) {
    const double value = iterate.values()[j];
    if (value < iterate.lower()[j] - iterate.tolerance() || value > iterate.upper()[j] + iterate.tolerance())
      return true;
  }
  return false;
}

}  // namespace

QuadraticSolution QuadraticSolver::solve(const QuadraticProgram& program) {
  if (sets_) return solve_from(program, warm_start(program, *sets_), true);
  if (options_.crash == Crash::none) return solve_from(program, slack_start(program), false);
  return solve_from(program, {program.column_count(), crash_basis(program).basics, {}}, true);
}

QuadraticSolution QuadraticSolver::solve_from(const QuadraticProgram& program, WorkingSet start, bool may_restart) {
  QuadraticSolution solution;
  try {
    Iterate iterate(program, std::move(start), options_.feasibility_tolerance);
    find_feasible_point(iterate, pricing_, options_.optimality_tolerance, observer_);
    if (may_restart && leaves_variable_outside(iterate)) return solve_from(program, slack_start(program), false);
    solution.infeasibility = iterate.infeasibility();
    if (solution.infeasibility > 0.0) iterate.accept_violations();
    solution.multipliers = -find_minimiser(iterate, pricing_, options_.optimality_tolerance, observer_);
    solution.step = iterate.variables();
    solution.status =
        solution.infeasibility > 0.0 ? QuadraticSolution::Status::infeasible : QuadraticSolution::Status::optimal;
    sets_ = iterate.sets();
  } catch (const Breakdown& reason) {
    sets_.reset();
    if (may_restart) return solve_from(program, slack_start(program), false);
    solution.status = QuadraticSolution::Status::breakdown;
    solution.message = reason.what();
  } catch (const Stopped&) {
    solution.status = QuadraticSolution::Status::stopped;
  }
  return solution;
}

}  // namespace dmocbench::sqp
