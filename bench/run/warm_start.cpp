#include "bench/run/warm_start.hpp"

#include "methods/transcription/sample_multipliers.hpp"

namespace dmocbench {

namespace {

bool takes_multipliers(const Solver& solver) { return solver.name() == "interior_point" || solver.name() == "auto"; }

}  // namespace

Solution solve_from(Transcription& program, const Eigen::VectorXd& start,
                    const std::optional<Trajectory>& with_costates, const Solver& solver) {
  if (!with_costates || !takes_multipliers(solver)) return solver.solve(program, start);
  Solution solution = solver.solve(program, start, sample_multipliers(program, *with_costates));
  if (is_solved(solution.status) || solution.status == Status::interrupted) return solution;
  Solution cold = solver.solve(program, start);
  cold.message += " With the costates of its start it had failed; this is the answer from the motion alone.";
  return cold;
}

}  // namespace dmocbench
