#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/extensions/primitives/roadmap_systems.hpp"
#include "bench/run/column.hpp"
#include "bench/tables/ratio_interval.hpp"
#include "methods/extensions/primitives/stored_roadmap.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// A roadmap with the time that it took.
struct TimedRoadmap {
  StoredRoadmap stored;
  double seconds = 0.0;
  bool is_read = false;  ///< from a file; else built
};

/// Options of the comparison of a plan.
struct PlanOptions {
  int repeats = 21;        ///< of the search, for its time
  double amplitude = 0.5;  ///< of the perturbed guesses of multi-start, as in `perturbed`
  std::uint64_t seed = 1;  ///< of them
};

/// The best of many starts.
struct MultiStart {
  std::size_t starts = 0;
  std::size_t solved = 0;
  std::optional<double> best = {};  ///< least cost of those that are motions
};

/// A plan on a roadmap, the full solve that starts from it, and the best of multi-start in the same time.
struct PlannedMotion {
  std::shared_ptr<const Problem> problem;
  const RoadmapSystem* system = nullptr;
  TimedRoadmap roadmap;
  std::optional<RatioInterval> milliseconds = {};  ///< of the search
  std::optional<RoadmapPath> path = {};            ///< empty if the goal is not reached
  std::optional<Trajectory> before = {};           ///< the concatenation
  std::string status = {};                         ///< of the full solve from there
  std::optional<Trajectory> after = {};            ///< its answer, if it is a motion
  double seconds = 0.0;                            ///< roadmap, one search, concatenation, full solve
  MultiStart multi_start = {};
};

/// Plans, refines by DMOC on the system's grid, and lets multi-start have the same time on the same program. Throws
/// `Stopped` where `solver_options` request a stop.
[[nodiscard]] PlannedMotion plan_and_refine(const std::shared_ptr<const Problem>& problem, const RoadmapSystem& system,
                                            TimedRoadmap roadmap, const PlanOptions& options,
                                            const SolverOptions& solver_options);

/// A point of the picture of a plan: where in the plane of the first two quantities of `ProblemCard::picture`, or of
/// q_1 and q_2 (`RoadmapSystem::shows_configurations`).
struct PicturePoint {
  std::string problem;
  std::string part;  ///< "node" of the roadmap, "joint" of the path, or the motion "before" or "after" the full solve
  std::optional<double> t;  ///< in the problem's unit of time; empty for nodes
  double x = 0.0;
  double y = 0.0;
  std::optional<double> u;  ///< the first control; empty for nodes
};

[[nodiscard]] Columns<PicturePoint> picture_columns();

/// The meanings of x and y of the points of a plan, in words with their unit.
struct PictureAxes {
  std::string x;
  std::string y;
};
[[nodiscard]] PictureAxes picture_axes(const PlannedMotion& planned);

/// Nodes (evenly chosen ones, if they are very many), path and motions.
[[nodiscard]] std::vector<PicturePoint> picture_of(const PlannedMotion& planned);

}  // namespace dmocbench
