#include "methods/diagnostics/undefined_point.hpp"

#include <fmt/format.h>

#include "methods/mechanics/formulas_along_motion.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

std::string UndefinedPoint::words() const {
  return fmt::format("The trajectory leaves the domain of the formulas: {} is not a number in interval {} (t = {:g}).",
                     quantity, interval, time);
}

namespace {

/// Checks eight points between the nodes of interval k.
std::optional<UndefinedPoint> undefined_between(FormulaCheck& check, const Trajectory& trajectory, Eigen::Index k) {
  constexpr int points_per_interval = 8;
  const double left = trajectory.node_times[k];
  const double width = trajectory.node_times[k + 1] - left;
  for (int i = 0; i < points_per_interval; ++i) {
    const double t = left + width * (i + 0.5) / points_per_interval;
    const MotionPoint point{.q = configuration_at(trajectory, t),
                            .v = velocity_on_interval(trajectory, k, t),
                            .u = control_on_interval(trajectory, k, t),
                            .y = first_order_on_interval(trajectory, k, t)};
    const std::string quantity = check.undefined_at(point, t);
    if (!quantity.empty()) return UndefinedPoint{quantity, k, t};
  }
  return std::nullopt;
}

}  // namespace

std::optional<UndefinedPoint> undefined_point(const Problem& problem, const Trajectory& trajectory) {
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  FormulaCheck check(problem);
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    if (auto found = undefined_between(check, trajectory, k)) return found;
  }
  return std::nullopt;
}

std::optional<UndefinedPoint> undefined_point(const Problem& problem, const Trajectory& trajectory,
                                              Eigen::Index interval) {
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  FormulaCheck check(problem);
  const ProblemBounds bounds = problem.bounds();
  for (const Eigen::Index node : {interval, interval + 1}) {
    const double t = trajectory.node_times[node];
    MotionPoint point{.q = trajectory.q.row(node).transpose(),
                      .v = trajectory.v.row(node).transpose(),
                      .u = control_on_interval(trajectory, interval, t),
                      .y = Trajectory::row_of(trajectory.y, node)};
    // Momenta give the velocity up to rounding; a prescribed one is exact, for example of a body at rest.
    if (node == 0 && bounds.first.v.all_fixed()) point.v = problem.initial_state().v;
    if (node == trajectory.intervals() && bounds.last.v.all_fixed()) point.v = problem.final_state().v;
    const std::string quantity = check.undefined_at(point, t);
    if (!quantity.empty()) return UndefinedPoint{quantity, interval, t};
  }
  return undefined_between(check, trajectory, interval);
}

}  // namespace dmocbench
