#include "methods/diagnostics/undefined_point.hpp"

#include <fmt/format.h>

#include "methods/mechanics/formula_check.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

std::string UndefinedPoint::words() const {
  return fmt::format(
      "The motion leaves the set where its formulas are defined: {} is not a number in interval {} (t = {:g}).",
      quantity, interval, time);
}

std::optional<UndefinedPoint> undefined_point(const Problem& problem, const Trajectory& trajectory) {
  constexpr int points_per_interval = 8;
  FormulaCheck check(problem);
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const double left = trajectory.node_times[k];
    const double width = trajectory.node_times[k + 1] - left;
    for (int i = 0; i < points_per_interval; ++i) {
      const double t = left + width * (i + 0.5) / points_per_interval;
      const MotionPoint point{.q = configuration_at(trajectory, t),
                              .v = velocity_on_interval(trajectory, k, t),
                              .u = control_on_interval(trajectory, k, t)};
      const std::string quantity = check.undefined_at(point, t);
      if (!quantity.empty()) return UndefinedPoint{quantity, k, t};
    }
  }
  return std::nullopt;
}

}  // namespace dmocbench
