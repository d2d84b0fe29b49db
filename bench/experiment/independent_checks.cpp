#include "bench/experiment/independent_checks.hpp"

#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/violation_between_nodes.hpp"
#include "methods/error.hpp"

namespace dmocbench {

std::optional<ReplayError> replay(SolvedCase& solved) {
  try {
    return replay_error(*solved.the_case.problem, *solved.trajectory);
  } catch (const Error& error) {
    solved.note(error.what());
    return std::nullopt;
  }
}

IndependentChecks check_independently(SolvedCase& solved) {
  const Problem& problem = *solved.the_case.problem;
  const Trajectory& trajectory = *solved.trajectory;
  IndependentChecks checks{.replay = replay(solved),
                           .violation_between_nodes = violation_between_nodes(problem, trajectory),
                           .free_horizon_residual = {}};
  if (problem.bounds().horizon.is_free() && trajectory.has_costates()) {
    checks.free_horizon_residual = free_horizon_residual(problem, trajectory);
  }
  return checks;
}

Column<SolvedCase> replay_error_column(const std::optional<ReplayError>& replay) {
  return {"replay_error", "", "distance from the final state when the controls are replayed",
          of(replay, &ReplayError::norm)};
}

Columns<SolvedCase> columns_of(const IndependentChecks& checks) {
  return {replay_error_column(checks.replay),
          {"replay_cost", "cost", "cost of the replayed motion", of(checks.replay, &ReplayError::cost)},
          {"violation_between_nodes", "", "of bounds and path constraints, where no point imposes them",
           of(checks.violation_between_nodes)},
          {"free_horizon_residual", "", "what is left of the condition on T; empty for a fixed horizon",
           of(checks.free_horizon_residual)}};
}

}  // namespace dmocbench
