#include "bench/experiment/warm_start.hpp"

#include <memory>

#include "methods/transcription/sample_multipliers.hpp"

namespace dmocbench {

namespace {

/// The same solver with start multipliers; null for one that has no use for them.
std::unique_ptr<Solver> with_multipliers(const Solver& solver, const Eigen::VectorXd& multipliers) {
  if (solver.name() != "interior_point" && solver.name() != "auto") return nullptr;
  SolverOptions options = solver.options();
  options.start_multipliers = multipliers;
  return make_solver(solver.name(), options);
}

}  // namespace

Solution solve_from(Transcription& program, const Eigen::VectorXd& start,
                    const std::optional<Trajectory>& with_costates, const Solver& solver) {
  if (!with_costates) return solver.solve(program, start);
  const auto warm = with_multipliers(solver, sample_multipliers(program, *with_costates));
  if (!warm) return solver.solve(program, start);
  Solution solution = warm->solve(program, start);
  if (is_solved(solution.status) || solution.status == Status::interrupted) return solution;
  Solution cold = solver.solve(program, start);
  cold.message += " With the costates of its start it had failed; this is the answer from the motion alone.";
  return cold;
}

}  // namespace dmocbench
