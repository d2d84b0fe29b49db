#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/extensions/primitives/planned_motion.hpp"
#include "bench/run/column.hpp"

namespace dmocbench {

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
