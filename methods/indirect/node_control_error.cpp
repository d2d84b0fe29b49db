#include "methods/indirect/node_control_error.hpp"

#include <algorithm>
#include <cmath>

#include "methods/indirect/control_from_costate.hpp"

namespace dmocbench {

double node_control_error(const Problem& problem, const Trajectory& trajectory, const Trajectory& reference) {
  const ControlFromCostate principle(problem);
  const Eigen::MatrixXd controls = principle.at_nodes(trajectory);
  const Eigen::MatrixXd exact = principle.at_nodes(reference);
  const Eigen::VectorXd& times = reference.node_times;
  const double coincidence = 1e-12 * (times[times.size() - 1] - times[0]);
  double largest = 0.0;
  for (Eigen::Index k = 0; k < controls.rows(); ++k) {
    const double t = trajectory.node_times[k];
    const auto above = std::lower_bound(times.begin(), times.end(), t - coincidence);
    if (above == times.end() || std::abs(*above - t) > coincidence) continue;
    largest = std::max(largest, (controls.row(k) - exact.row(above - times.begin())).norm());
  }
  return largest;
}

}  // namespace dmocbench
