#include "bench/extensions/primitives/planned_motion.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>
#include <vector>

#include "bench/run/solve_case.hpp"
#include "bench/run/start_provider.hpp"
#include "methods/diagnostics/accuracy.hpp"
#include "methods/extensions/primitives/stored_roadmap.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

Case full_solve_of(const PlannedMotion& planned) {
  return {.problem = planned.problem,
          .method = "dmoc",
          .tableau = "gauss",
          .stages = planned.system->stages,
          .solver = "interior_point",
          .grid = Grid::uniform(planned.system->intervals)};
}

std::optional<RoadmapPath> path_on(const StoredRoadmap& stored, const Problem& problem) {
  const auto steps = static_cast<int>(std::lround(problem.horizon() / stored.library.step));
  return cheapest_path(stored.roadmap, stored.start, stored.goal, steps);
}

/// The search again and again; the first time is not counted.
RatioInterval timed_search(const StoredRoadmap& stored, const Problem& problem, int repeats) {
  std::vector<double> milliseconds;
  for (int repeat = 0; repeat <= repeats; ++repeat) {
    stop_if_requested();
    const auto begin = Clock::now();
    static_cast<void>(path_on(stored, problem));
    if (repeat > 0) milliseconds.push_back(1e3 * seconds_since(begin));
  }
  return ratio_interval(milliseconds);
}

/// An answer of multi-start.
struct StartAnswer {
  double objective = 0.0;  ///< scaled
  Eigen::VectorXd primal;
};

/// The cheapest answer that is a motion, at its true cost.
std::optional<double> best_motion(Transcription& program, std::vector<StartAnswer> answers) {
  std::ranges::sort(answers, {}, &StartAnswer::objective);
  constexpr std::size_t most_looked_at = 200;
  for (const StartAnswer& answer : answers | std::views::take(most_looked_at)) {
    const Trajectory trajectory = read_trajectory(program, answer.primal, {});
    if (accuracy(program.problem(), trajectory).relative_jump <= largest_jump_of_a_motion) return trajectory.cost;
  }
  return std::nullopt;
}

/// Solves from the guess and from perturbed guesses, eight at a time, until the time is over.
MultiStart multi_start(const Case& the_case, double seconds, const PlanOptions& options,
                       const SolverOptions& solver_options) {
  const auto begin = Clock::now();
  const std::unique_ptr<Transcription> program = the_case.transcribe();
  const auto lanes = lanes_of(*program);
  const Motion guess = guessed_motion(*the_case.problem);
  const Eigen::VectorXd usual = sample(*program, guess);
  const std::unique_ptr<Transcription> sampler = the_case.transcribe();  // `next` must not touch the program
  MultiStart result;
  std::vector<StartAnswer> answers;
  const auto is_over = [&] { return seconds_since(begin) > seconds; };
  const auto next = [&](std::size_t index, BatchInstance& instance) {
    if (index > 0 && is_over()) return false;
    instance.start = sample(*sampler, perturbed(guess, options.amplitude, options.seed, index));
    ++result.starts;
    return true;
  };
  const auto take = [&](std::size_t /*index*/, const Solution& solution) {
    if (!is_solved(solution.status)) return;
    ++result.solved;
    answers.push_back({solution.objective, solution.primal});
  };
  const auto stop = [&] { return is_over() || (solver_options.stop_requested && solver_options.stop_requested()); };
  solve_batch(*program, lanes, usual, next, take,
              {.tolerance = solver_options.tolerance, .most_iterations = 200, .stop_requested = stop});
  stop_if_requested();
  result.best = best_motion(*program, std::move(answers));
  return result;
}

}  // namespace

PlannedMotion plan_and_refine(const std::shared_ptr<const Problem>& problem, const RoadmapSystem& system,
                              TimedRoadmap roadmap, const PlanOptions& options, const SolverOptions& solver_options) {
  PlannedMotion planned{.problem = problem, .system = &system, .roadmap = std::move(roadmap)};
  const StoredRoadmap& stored = planned.roadmap.stored;
  planned.milliseconds = timed_search(stored, *problem, options.repeats);
  const auto begin = Clock::now();
  planned.path = path_on(stored, *problem);
  if (!planned.path) {
    planned.status = "no path";
    return planned;
  }
  planned.before = concatenate(*problem, stored.library, stored.roadmap, *planned.path);
  const Case the_case = full_solve_of(planned);
  const auto solver = make_solver(the_case.solver, solver_options);
  SolvedCase solved =
      solve_case(the_case, {.motion = smooth_motion(*planned.before)}, *solver, solver_options.tolerance, 1);
  stop_if_requested();
  planned.status = name_of(solved.solution.status);
  if (is_solved(solved.solution.status)) planned.after = std::move(solved.trajectory);
  planned.seconds = planned.roadmap.seconds + seconds_since(begin);
  planned.multi_start = multi_start(the_case, planned.seconds, options, solver_options);
  return planned;
}

}  // namespace dmocbench
