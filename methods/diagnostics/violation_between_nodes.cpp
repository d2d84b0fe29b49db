#include "methods/diagnostics/violation_between_nodes.hpp"

#include <algorithm>
#include <limits>

#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

namespace {

double outside(const Eigen::VectorXd& x, const Bounds& bounds) {
  if (bounds.empty() || x.size() == 0) return 0.0;
  return std::max(0.0, std::max((bounds.lower - x).maxCoeff(), (x - bounds.upper).maxCoeff()));
}

}  // namespace

double violation_between_nodes(const Problem& problem, const Trajectory& trajectory) {
  constexpr int points_per_interval = 16;
  const TracedProblem traced(problem);
  const ProblemBounds bounds = problem.bounds();
  PointFunction path(traced.configuration_size(), traced.control_size(),
                     [&](const ControlledState& x) { return traced.at(x).path_constraints; });
  Eigen::VectorXd h(path.output_count());
  double worst = 0.0;
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const double left = trajectory.node_times[k];
    const double width = trajectory.node_times[k + 1] - left;
    for (int i = 0; i <= points_per_interval; ++i) {
      const double t = left + width * i / points_per_interval;
      const Eigen::VectorXd q = configuration_at(trajectory, t);
      const Eigen::VectorXd v = velocity_on_interval(trajectory, k, t);
      const Eigen::VectorXd u = control_on_interval(trajectory, k, t);
      worst = std::max({worst, outside(q, bounds.q), outside(v, bounds.v), outside(u, bounds.u)});
      if (h.size() == 0) continue;
      path.evaluate(q, v, u, t, h);
      // Where a constraint is not a number, the motion has left its domain.
      worst = h.allFinite() ? std::max(worst, -h.minCoeff()) : std::numeric_limits<double>::infinity();
    }
  }
  return worst;
}

}  // namespace dmocbench
