// Global minima by roadmaps of DMOC primitives (section 5 of the paper): plans, full solves that start from them, and
// multi-start for comparison.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/extensions/primitives/planned_motion.hpp"
#include "bench/extensions/primitives/roadmap_file.hpp"
#include "bench/run/column.hpp"
#include "bench/run/options.hpp"
#include "bench/run/table_run.hpp"
#include "methods/error.hpp"
#include "methods/runtime/clock.hpp"

namespace dmocbench::primitives_program {

const StoredRoadmap& stored_of(const PlannedMotion& planned) { return planned.roadmap.stored; }

std::optional<double> reference_cost(const PlannedMotion& planned) {
  const auto reference = planned.problem->card().reference;
  return reference ? std::optional(reference->objective) : std::nullopt;
}

/// J / J* - 1.
std::optional<double> excess(const PlannedMotion& planned, const std::optional<double>& cost) {
  const std::optional<double> reference = reference_cost(planned);
  if (!cost || !reference) return std::nullopt;
  return *cost / *reference - 1.0;
}

std::optional<double> cost_of(const std::optional<Trajectory>& motion) {
  return motion ? std::optional(motion->cost) : std::nullopt;
}

const Columns<PlannedMotion> columns{
    {"problem", "", "name of the problem", [](const PlannedMotion& p) { return p.problem->name(); }, in_key},
    {"states", "", "kind of the nodes", [](const PlannedMotion& p) { return p.system->nodes; }},
    {"horizontal", "", "quantity x of primitives_picture", [](const PlannedMotion& p) { return picture_axes(p).x; }},
    {"vertical", "", "quantity y of primitives_picture", [](const PlannedMotion& p) { return picture_axes(p).y; }},
    {"primitives", "", "number of primitives in the library",
     [](const PlannedMotion& p) { return stored_of(p).library.primitives.size(); }},
    {"nodes", "", "number of nodes of the roadmap",
     [](const PlannedMotion& p) { return stored_of(p).roadmap.nodes().size(); }},
    {"edges", "", "number of edges of the roadmap",
     [](const PlannedMotion& p) { return stored_of(p).roadmap.edges().size(); }},
    {"roadmap", "", "built or read", [](const PlannedMotion& p) { return p.roadmap.is_read ? "read" : "built"; }},
    {"roadmap_seconds", "s", "time to build or read the roadmap",
     [](const PlannedMotion& p) { return p.roadmap.seconds; }},
    {"plan_milliseconds", "ms", "median time of a search on the roadmap",
     from(&PlannedMotion::milliseconds, &RatioInterval::ratio)},
    {"plan_lower", "ms", "lower 99 % confidence limit", from(&PlannedMotion::milliseconds, &RatioInterval::lower)},
    {"plan_upper", "ms", "upper 99 % confidence limit", from(&PlannedMotion::milliseconds, &RatioInterval::upper)},
    {"rounds", "", "number of timed searches", from(&PlannedMotion::milliseconds, &RatioInterval::rounds)},
    {"path_edges", "", "number of edges of the path",
     [](const PlannedMotion& p) { return p.path ? std::optional(p.path->edges.size()) : std::nullopt; }},
    {"cost_before", "cost", "cost of the joined primitives", [](const PlannedMotion& p) { return cost_of(p.before); }},
    {"status", "", "status of the full solve that starts from them", &PlannedMotion::status},
    {"cost_after", "cost", "cost of the full solve", [](const PlannedMotion& p) { return cost_of(p.after); }},
    {"reference_cost", "cost", "cost of the optimum that the problem states", reference_cost},
    {"excess_before", "", "cost_before / reference_cost - 1",
     [](const PlannedMotion& p) { return excess(p, cost_of(p.before)); }},
    {"excess_after", "", "cost_after / reference_cost - 1",
     [](const PlannedMotion& p) { return excess(p, cost_of(p.after)); }},
    {"total_seconds", "s", "time of roadmap, search and full solve", &PlannedMotion::seconds},
    {"starts", "", "number of multi-start solves in the same time",
     from(&PlannedMotion::multi_start, &MultiStart::starts)},
    {"solved_starts", "", "number of solved starts", from(&PlannedMotion::multi_start, &MultiStart::solved)},
    {"start_motions", "", "1 if the cheapest solution is confirmed, 0 otherwise",
     [](const PlannedMotion& p) { return p.multi_start.best ? 1 : 0; }},
    {"best_of_starts", "cost", "least cost of the confirmed solutions of these solves",
     from(&PlannedMotion::multi_start, &MultiStart::best)},
    {"excess_of_starts", "", "best_of_starts / reference_cost - 1",
     [](const PlannedMotion& p) { return excess(p, p.multi_start.best); }}};

/// The choices of a user.
struct PrimitivesOptions {
  ProblemOptions asked{.problems = all_names()};
  std::filesystem::path roadmap = {};
  std::filesystem::path store = {};
  PlanOptions plan = {};

  static std::vector<std::string> all_names() {
    std::vector<std::string> names;
    for (const RoadmapSystem& each : roadmap_systems()) names.push_back(each.problem);
    return names;
  }
};

void add_options(CommandLine& line, PrimitivesOptions& options) {
  options.asked.add_to(line);
  line.option("--roadmap", options.roadmap,
              "read the roadmap from this file instead of building it; needs exactly one problem");
  line.option("--store", options.store, "store the roadmap in this file; needs exactly one problem");
  line.number("--repeats", options.plan.repeats, 1, 100000, "number of timed searches");
  line.number("--seed", options.plan.seed, 0, 0xffffffffU, "seed of the perturbed guesses of multi-start");
  line.number("--amplitude", options.plan.amplitude, 0.0, 10.0,
              "size of the perturbations, relative to the range of each coordinate");
}

TimedRoadmap roadmap_for(const PrimitivesOptions& options, const Problem& problem, const RoadmapSystem& system) {
  const auto begin = Clock::now();
  if (!options.roadmap.empty()) {
    StoredRoadmap stored = read_roadmap(options.roadmap, problem);
    return {.stored = std::move(stored), .seconds = seconds_since(begin), .is_read = true};
  }
  PrimitiveOptions primitive_options;
  primitive_options.stop_requested = TableRun::solver_options().stop_requested;
  StoredRoadmap stored = system.build(problem, primitive_options);
  stop_if_requested();
  return {.stored = std::move(stored), .seconds = seconds_since(begin), .is_read = false};
}

void print(const PlannedMotion& planned) {
  const auto shown = [](const std::optional<double>& number) { return number ? fmt::format("{:.6g}", *number) : "-"; };
  fmt::print(
      "{}: {} nodes, {} edges in {:.2f} s; search in {} ms; cost {} before and {} after the full solve, reference {}; "
      "best of {} starts {}\n",
      planned.problem->name(), stored_of(planned).roadmap.nodes().size(), stored_of(planned).roadmap.edges().size(),
      planned.roadmap.seconds, shown(planned.milliseconds ? std::optional(planned.milliseconds->ratio) : std::nullopt),
      shown(cost_of(planned.before)), shown(cost_of(planned.after)), shown(reference_cost(planned)),
      planned.multi_start.starts, shown(planned.multi_start.best));
}

int measure_all(CommandLine& line) {
  PrimitivesOptions options;
  add_options(line, options);
  TableRun run("primitives", line);
  const auto problems = run.selected(options.asked);
  if (problems.size() != 1 && !(options.roadmap.empty() && options.store.empty())) {
    throw Error("--roadmap and --store need exactly one problem; name it with --problem");
  }
  if (!options.store.empty()) require_writable(options.store);
  std::vector<PlannedMotion> rows;
  std::vector<PicturePoint> points;
  for (const auto& problem : problems) {
    const RoadmapSystem& system = roadmap_system(problem->name());
    run.show(fmt::format("{}: the roadmap", problem->name()));
    TimedRoadmap roadmap = roadmap_for(options, *problem, system);
    if (!options.store.empty()) write_roadmap(options.store, roadmap.stored);
    run.show(fmt::format("{}: plan, full solve, multi-start", problem->name()));
    rows.push_back(plan_and_refine(problem, system, std::move(roadmap), options.plan, TableRun::solver_options()));
    const std::vector<PicturePoint> picture = picture_of(rows.back());
    points.insert(points.end(), picture.begin(), picture.end());
    print(rows.back());
  }
  run.add("primitives", columns, rows);
  run.add("primitives_picture", picture_columns(), points);
  return run.write();
}

int run(int argc, char** argv) {
  return run_program(
      "primitives",
      "Builds roadmaps of short DMOC solves between trims or states. Measures nodes, edges, the times to build and to "
      "search, and the cost of the path before and after a full solve that starts from it. Compares this cost with the "
      "optimum that the problem states and with the best of many perturbed guesses in the same total time "
      "(primitives.csv; trajectories and nodes in primitives_picture.csv).",
      argc, argv, measure_all);
}

}  // namespace dmocbench::primitives_program
