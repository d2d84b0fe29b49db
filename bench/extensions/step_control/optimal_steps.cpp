#include "bench/extensions/step_control/optimal_steps.hpp"

#include <cmath>

#include "bench/run/solve_case.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/error.hpp"
#include "methods/extensions/step_control/step_control_program.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

SteppedTransfer::SteppedTransfer(double eccentricity, const SolverOptions& options)
    : problem_(std::make_shared<EllipseTransfer>(eccentricity)), solver_(make_solver("ipopt", options)) {
  constexpr long long intervals = 96;
  const Case the_case{
      .problem = problem_, .method = "dmoc", .stages = 3, .solver = "ipopt", .grid = Grid::uniform(intervals)};
  const SolvedCase solved =
      solve_case(the_case, Start{guessed_motion(*problem_)}, *solver_, solver_->options().tolerance, 1, true);
  if (!solved.trajectory || !is_usable(solved)) throw Error("the transfer is not solved: " + solved.solution.message);
  optimum_ = std::make_unique<const IndirectSolution>(solve_indirect(*problem_, *solved.trajectory));
  motion_ = smooth_motion(optimum_->trajectory());
}

OptimalSteps SteppedTransfer::solve(StepPolicy rule, const StepFunction& sigma, int stages, long long intervals) const {
  if (rule == StepPolicy::variational) {
    StepControlProgram program(*problem_, gauss_tableau(stages), sigma, static_cast<std::size_t>(intervals));
    const Solution solution = solver_->solve(program, program.start(motion_));
    return steps_of(solution, program.variable_count(), [&] { return program.read(solution.primal); });
  }
  const Grid grid = rule == StepPolicy::uniform
                        ? Grid::uniform(intervals)
                        : Grid::from_nodes(step_times(sigma, motion_, intervals).times / motion_.horizon);
  const auto program = Case{.problem = problem_, .method = "dmoc", .stages = stages, .grid = grid}.transcribe();
  const Solution solution = solver_->solve(*program, sample(*program, motion_));
  return steps_of(solution, program->variable_count(),
                  [&] { return read_trajectory(*program, solution.primal, solution.multipliers); });
}

OptimalSteps SteppedTransfer::steps_of(const Solution& solution, std::size_t variables,
                                       const std::function<Trajectory()>& read) const {
  OptimalSteps result{.status = std::string(name_of(solution.status)), .variables = variables};
  if (!is_solved(solution.status)) return result;
  const Trajectory motion = read();
  const TrajectoryError error = trajectory_error(motion, optimum_->sampled_like(motion));
  result.errors = StepsErrors{.cost = std::abs(motion.cost / optimum_->cost() - 1.0),
                              .state = error.state,
                              .control = error.control,
                              .momentum = momentum_consistency(*problem_, motion).largest,
                              .replay = replay_error(*problem_, motion).norm()};
  return result;
}

}  // namespace dmocbench
