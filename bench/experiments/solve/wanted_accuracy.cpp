#include "bench/experiments/solve/wanted_accuracy.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "bench/run/command_line.hpp"
#include "bench/run/start_provider.hpp"
#include "methods/error.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/transcription/start.hpp"

namespace dmocbench {

SolvedCase solve_accurately(Case the_case, const Start& start, const AdaptiveOptions& options,
                            const std::function<void(const GridAttempt&)>& on_grid) {
  const auto begin = Clock::now();
  AdaptiveAnswer answer = solve_adaptively({.problem = the_case.problem.get(),
                                            .method = the_case.method,
                                            .tableau = the_case.tableau,
                                            .stages = the_case.stages,
                                            .first = the_case.grid,
                                            .start = start.motion},
                                           options, on_grid);
  if (answer.program) {
    the_case.grid = answer.program->grid();
    the_case.stages = static_cast<int>(answer.program->tableau().stages());
  }
  SolvedCase solved{.the_case = std::move(the_case), .program = std::move(answer.program)};
  solved.solution = std::move(answer.solution);
  if (!solved.program) {  // the time was up before
    solved.solution.message = answer.message;
    return solved;
  }
  const bool has_motion = answer.trajectory.node_times.size() > 0;
  solved.start = sample(*solved.program, has_motion ? smooth_motion(answer.trajectory) : start.motion);
  SolverOptions solver_options = options.solver_options;
  solved.tolerance = options.solver_tolerance(solver_options.tolerance);
  if (double& limit = solver_options.most_seconds; limit > 0.0) {
    constexpr double moment = 1e-9;
    limit = std::max(limit - seconds_since(begin), moment);
    solved.seconds_left = limit;
  }
  judge_case(solved, start, solver_options);
  if (answer.outcome == AdaptiveOutcome::reached) {
    solved.estimated_error = answer.estimate.relative;
    solved.note(answer.message);
  } else {
    if (is_solved(solved.solution.status)) solved.solution.status = Status::not_confirmed;
    solved.solution.message = std::move(answer.message);
  }
  return solved;
}

void WantedAccuracy::add_to(CommandLine& line) {
  line.option("--accuracy", accuracy_,
              "refine the grid of one case, starting at --intervals or --grid, until the estimated relative error of "
              "q, p and cost is at most this value, 1e-14 to 0.1; counts and times include all grids");
  line.option("--refine", refine_,
              "refinement for --accuracy: h (steps) or hp (steps, and up to three stages); default: h");
}

void WantedAccuracy::check(const std::vector<Case>& cases) {
  if (!is_wanted()) {
    if (!refine_.empty()) throw Error("--refine selects how --accuracy refines; give --accuracy too");
    return;
  }
  if (cases.size() != 1)
    throw Error("--accuracy refines exactly one case; choose one method, one number of stages and one first grid");
  adaptive_.accuracy = parse_number("--accuracy", accuracy_);
  if (!refine_.empty()) adaptive_.refinement = refinement_named(refine_);
  try {
    adaptive_.validate();
  } catch (const Error& error) {
    throw Error("--accuracy: {}", error.what());
  }
}

void WantedAccuracy::note(const GridAttempt& grid, const Case& the_case) {
  const Unit time = the_case.problem->card().time_unit;
  const auto in_unit = [&](double step) {
    return fmt::format("{:.4g}{}{}", time.factor * step, time.name.empty() ? "" : " ", time.name);
  };
  Row row;
  row.set("grid", grids_.rows().size() + 1);
  row.set("N", grid.intervals);
  row.set("stages", grid.stages);
  row.set("estimated error",
          is_solved(grid.status) ? fmt::format("{:.2e}", grid.relative) : std::string(name_of(grid.status)));
  row.set("largest step", in_unit(grid.largest_step));
  row.set("smallest step", in_unit(grid.smallest_step));
  row.set("iterations", grid.iterations);
  row.set("seconds with setup", fmt::format("{:.2g}", grid.seconds));
  grids_.append(std::move(row));
}

SolvedCase WantedAccuracy::solve(SolveTask task) {
  const Case& the_case = task.the_case;
  if (the_case.form != CostForm::bolza || the_case.derivatives != "tape") {
    throw Error("--accuracy supports only --form bolza and --derivatives tape");
  }
  if (task.repeats > 1) throw Error("--accuracy solves only once on each grid; leave out --repeats");
  AdaptiveOptions options = adaptive_;
  options.solver = the_case.solver;
  options.solver_options = task.options;
  options.named_options = task.named_options;
  ProgressLine progress("solve");
  const auto on_grid = [&](const GridAttempt& grid) {
    note(grid, the_case);
    const std::string& error = grids_.rows().back().text("estimated error");
    if (progress.is_shown()) progress.show(fmt::format("N = {}, estimated error {}", grid.intervals, error));
  };
  return solve_accurately(the_case, task.start, options, on_grid);
}

}  // namespace dmocbench
