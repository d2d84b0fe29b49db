#include "bench/extensions/primitives/planned_motion.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

#include <fmt/format.h>

#include "bench/run/solve_case.hpp"
#include "bench/run/start_provider.hpp"
#include "methods/diagnostics/accuracy.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/point_of_inputs.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

Case full_solve_of(const PlannedMotion& planned) {
  return {.problem = planned.problem,
          .method = "dmoc",
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
    if (accuracy(program.problem(), trajectory).is_motion()) return trajectory.cost;
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

namespace {

/// The two quantities of the plane. Of a single q on a lattice its velocity is the second.
Picture plane_of(const Problem& problem, bool shows_configurations, const ControlledState& x) {
  if (!shows_configurations) {
    const Picture all = pictured_quantities(problem, x);
    return {all.at(0), all.at(1)};
  }
  const std::vector<std::string> names = problem.configuration_names();
  const ProblemCard card = problem.card();
  std::vector<std::string> units = card.configuration_units;
  units.resize(names.size());
  if (names.size() > 1) return {{names[0], units[0], x.q[0]}, {names[1], units[1], x.q[1]}};
  const bool is_known = !units[0].empty() && card.time_unit.factor == 1.0;  // v is per unit of the problem's time
  return {{names[0], units[0], x.q[0]},
          {"velocity of " + names[0], is_known ? units[0] + "/" + card.time_unit.name : "", x.v[0]}};
}

std::string with_unit(const PictureQuantity& quantity) {
  return quantity.unit.empty() ? quantity.name : fmt::format("{} [{}]", quantity.name, quantity.unit);
}

/// The positions of states in the plane.
class PicturePlane {
 public:
  PicturePlane(const Problem& problem, bool shows_configurations)
      : name_(problem.name()),
        function_(problem.configuration_size(), problem.control_size(), [&](const ControlledState& x) {
          const Picture plane = plane_of(problem, shows_configurations, x);
          return ExpressionVector{{plane[0].value, plane[1].value}};
        }) {}

  [[nodiscard]] PicturePoint at(const std::string& part, const BoundaryState& state, std::optional<double> t,
                                std::optional<double> u) {
    Eigen::VectorXd place(2);
    function_.evaluate(state.q, state.v, Eigen::VectorXd(), 0.0, place);
    return {.problem = name_, .part = part, .t = t, .x = place[0], .y = place[1], .u = u};
  }

 private:
  std::string name_;
  PointFunction function_;
};

void add_motion(const Trajectory& motion, const std::string& part, double time_unit, PicturePlane& plane,
                std::vector<PicturePoint>& points) {
  for (Eigen::Index k = 0; k <= motion.intervals(); ++k) {
    const MotionPoint node = motion.node(k);
    const double t = motion.node_times[k];
    points.push_back(plane.at(part, {node.q, node.v}, t * time_unit, control_at(motion, t)[0]));
  }
}

}  // namespace

Columns<PicturePoint> picture_columns() {
  return {{"problem", "", "name of the problem", &PicturePoint::problem},
          {"part", "", "node of the roadmap, joint of the path, or trajectory before or after the full solve",
           &PicturePoint::part},
          {"t", "", "time in the problem's unit; empty for nodes", &PicturePoint::t},
          {"x", "", "first quantity of the problem's picture, or q_1 for a lattice of states", &PicturePoint::x},
          {"y", "", "second quantity of the picture, q_2, or the velocity of a single q", &PicturePoint::y},
          {"u", "", "first control; empty for nodes", &PicturePoint::u}};
}

PictureAxes picture_axes(const PlannedMotion& planned) {
  const Problem& problem = *planned.problem;
  const Picture plane = plane_of(problem, planned.system->shows_configurations, point_of_inputs(problem));
  return {.x = with_unit(plane[0]), .y = with_unit(plane[1])};
}

std::vector<PicturePoint> picture_of(const PlannedMotion& planned) {
  const auto& [library, roadmap, start, goal] = planned.roadmap.stored;
  PicturePlane plane(*planned.problem, planned.system->shows_configurations);
  std::vector<PicturePoint> points;
  const auto state_of = [&](std::size_t node) {
    const RoadmapNode& at = roadmap.nodes()[node];
    return at.moved.state(library.states[at.state]);
  };
  constexpr std::size_t most_nodes = 1500;
  const std::size_t stride = 1 + roadmap.nodes().size() / most_nodes;
  for (std::size_t node = 0; node < roadmap.nodes().size(); node += stride) {
    points.push_back(plane.at("node", state_of(node), {}, {}));
  }
  if (!planned.path) return points;
  const double time_unit = planned.problem->card().time_unit.factor;
  points.push_back(plane.at("joint", state_of(start), {}, {}));
  for (const std::size_t edge : planned.path->edges) {
    points.push_back(plane.at("joint", state_of(roadmap.edges()[edge].to), {}, {}));
  }
  if (planned.before) add_motion(*planned.before, "before", time_unit, plane, points);
  if (planned.after) add_motion(*planned.after, "after", time_unit, plane, points);
  return points;
}

}  // namespace dmocbench
