#include "methods/diagnostics/trajectory_error.hpp"

#include <algorithm>
#include <cmath>

#include "methods/transcription/interpolation.hpp"

namespace dmocbench {

TrajectoryError trajectory_error(const Trajectory& trajectory, const Trajectory& reference) {
  TrajectoryError error;
  const bool compare_costates = trajectory.has_costates() && reference.has_costates();
  if (compare_costates) error.costate = 0.0;
  const auto horizon = [](const Trajectory& motion) { return motion.node_times[motion.intervals()]; };
  const double stretch = horizon(reference) / horizon(trajectory);
  for (Eigen::Index k = 0; k < trajectory.node_times.size(); ++k) {
    const double t = trajectory.node_times[k] * stretch;
    const auto node = node_at(reference.node_times, t);
    const Eigen::VectorXd q =
        node ? Eigen::VectorXd(reference.q.row(*node).transpose()) : configuration_at(reference, t);
    error.state = std::max(error.state, (trajectory.q.row(k).transpose() - q).norm());
    if (!node) continue;
    error.momentum = std::max(error.momentum, (trajectory.p.row(k) - reference.p.row(*node)).norm());
    if (compare_costates) {
      const double difference = std::hypot((trajectory.psi_q.row(k) - reference.psi_q.row(*node)).norm(),
                                           (trajectory.psi_p.row(k) - reference.psi_p.row(*node)).norm());
      error.costate = std::max(*error.costate, difference);
    }
  }
  for (Eigen::Index i = 0; i < trajectory.stage_times.size(); ++i) {
    const bool ends_interval = trajectory.tableau.c[i % trajectory.stages()] == 1.0;
    const Eigen::VectorXd u =
        control_at(reference, trajectory.stage_times[i] * stretch, ends_interval ? Side::left : Side::right);
    error.control = std::max(error.control, (trajectory.stage_u.row(i).transpose() - u).norm());
  }
  error.objective = std::abs(trajectory.cost - reference.cost);
  return error;
}

}  // namespace dmocbench
