#include "bench/experiments/wanted_accuracy.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "bench/run/command_line.hpp"
#include "bench/run/start_provider.hpp"
#include "methods/error.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/start.hpp"

namespace dmocbench {

namespace {

/// Prints a line for each grid as soon as it is solved.
auto grid_printer(const Unit& time) {
  return [time, number = 0](const GridAttempt& grid) mutable {
    if (number == 0) {
      fmt::print("solve: grid intervals stages estimated_error largest_step smallest_step{} iterations seconds\n",
                 time.name.empty() ? "" : " [" + time.name + "]");
    }
    fmt::print("solve: {:4} {:9} {:6} {:>15} {:12.4g} {:13.4g} {:10} {:.4f}\n", ++number, grid.intervals, grid.stages,
               is_solved(grid.status) ? fmt::format("{:.2e}", grid.relative) : std::string(name_of(grid.status)),
               time.factor * grid.largest_step, time.factor * grid.smallest_step, grid.iterations, grid.seconds);
  };
}

/// The answer on the last grid. Throws `NoStart` if the time is up between two grids.
AdaptiveAnswer solve_on_grids(const SolveTask& asked, const AdaptiveOptions& options) {
  const Case& the_case = asked.the_case;
  const AdaptiveTask task{.problem = the_case.problem.get(),
                          .method = the_case.method,
                          .tableau = the_case.tableau,
                          .stages = the_case.stages,
                          .first = the_case.grid,
                          .start = asked.start.motion};
  const StopScope scope(asked.options.stop_requested, asked.options.most_seconds);
  try {
    AdaptiveAnswer answer = solve_adaptively(task, options, grid_printer(the_case.problem->card().time_unit));
    print_line(fmt::format("solve: {}", answer.message));
    return answer;
  } catch (const Stopped&) {
    const bool interrupted = asked.options.stop_requested && asked.options.stop_requested();
    throw NoStart("The time was up between two grids.", interrupted ? Status::interrupted : Status::time_limit);
  }
}

}  // namespace

void WantedAccuracy::add_to(CommandLine& line) {
  line.option(
      "--accuracy", accuracy_,
      "estimated relative error of q, p and cost at which to stop, 1e-14 to 0.1: refines one case grid by grid, "
      "beginning with --intervals or --grid");
  line.option("--refine", refine_, "with --accuracy: h (steps) or hp (steps, and up to three stages); default: h");
}

void WantedAccuracy::check(const std::vector<Case>& cases) {
  if (!is_wanted()) {
    if (!refine_.empty()) throw Error("--refine selects how --accuracy is reached; give --accuracy too");
    return;
  }
  if (cases.size() != 1)
    throw Error("--accuracy refines exactly one case: one method, one number of stages, one first grid");
  adaptive_.accuracy = parse_number("--accuracy", accuracy_);
  if (!refine_.empty()) adaptive_.refinement = refinement_named(refine_);
  try {
    adaptive_.validate();
  } catch (const Error& error) {
    throw Error(fmt::format("--accuracy: {}", error.what()));
  }
}

SolvedCase WantedAccuracy::solve(SolveTask task) {
  Case& the_case = task.the_case;
  if (the_case.form != CostForm::bolza || the_case.derivatives != "tape") {
    throw Error("--accuracy refines with --form bolza and --derivatives tape");
  }
  const auto begin = Clock::now();
  AdaptiveOptions options = adaptive_;
  options.solver = the_case.solver;
  options.solver_options = task.options;
  options.named_options = task.named_options;
  const AdaptiveAnswer answer = solve_on_grids(task, options);
  const double spent = seconds_since(begin);
  const GridAttempt& last = answer.grids.back();
  if (answer.outcome != AdaptiveOutcome::reached) {
    throw NoStart(answer.message, is_solved(last.status) ? Status::not_confirmed : last.status);
  }
  the_case.grid = answer.program->grid();
  the_case.stages = static_cast<int>(last.stages);
  task.start.motion = smooth_motion(answer.trajectory);
  task.start.with_costates = answer.trajectory;
  constexpr double moment = 1e-9;
  double& most_seconds = task.options.most_seconds;
  if (most_seconds > 0.0) most_seconds = std::max(most_seconds - spent, moment);
  task.options.tolerance = options.solver_tolerance(task.options.tolerance);
  SolvedCase solved = task.by(*make_solver(the_case.solver, task.options, task.named_options));
  solved.estimated_error = answer.estimate.relative;
  return solved;
}

}  // namespace dmocbench
