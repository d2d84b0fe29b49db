#include "bench/experiment/independent_checks.hpp"

#include "methods/diagnostics/control_hamiltonian.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/diagnostics/violation_between_nodes.hpp"
#include "methods/error.hpp"

namespace dmocbench {

const std::vector<std::string>& independent_check_columns() {
  static const std::vector<std::string> columns{"replay_error", "replay_cost", "violation_between_nodes",
                                                "free_horizon_residual"};
  return columns;
}

void check_independently(SolvedCase& solved) {
  const Problem& problem = *solved.what.problem;
  const Trajectory& trajectory = *solved.trajectory;
  try {
    const ReplayError replay = replay_error(problem, trajectory);
    solved.row.set("replay_error", replay.norm());
    solved.row.set("replay_cost", replay.cost);
  } catch (const Error& error) {
    solved.row.set("message", solved.row.text("message") + " " + error.what());
  }
  solved.row.set("violation_between_nodes", violation_between_nodes(problem, trajectory));
  if (problem.bounds().horizon.is_free() && trajectory.has_costates()) {
    solved.row.set("free_horizon_residual", free_horizon_residual(problem, trajectory));
  }
}

}  // namespace dmocbench
