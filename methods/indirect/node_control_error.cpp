#include "methods/indirect/node_control_error.hpp"

#include <algorithm>

#include "methods/indirect/control_from_costate.hpp"
#include "methods/transcription/interpolation.hpp"

namespace dmocbench {

double node_control_error(const Problem& problem, const Trajectory& trajectory, const Trajectory& reference) {
  const ControlFromCostate principle(problem);
  const Eigen::MatrixXd controls = principle.at_nodes(trajectory);
  const Eigen::MatrixXd exact = principle.at_nodes(reference);
  double largest = 0.0;
  for (Eigen::Index k = 0; k < controls.rows(); ++k) {
    const auto node = node_at(reference.node_times, trajectory.node_times[k]);
    if (node) largest = std::max(largest, (controls.row(k) - exact.row(*node)).norm());
  }
  return largest;
}

}  // namespace dmocbench
