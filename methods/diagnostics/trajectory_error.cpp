#include "methods/diagnostics/trajectory_error.hpp"

#include <algorithm>
#include <cmath>

#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

namespace {

double largest_distance(const Eigen::MatrixXd& values, const Eigen::MatrixXd& reference) {
  return (values - reference).rowwise().norm().maxCoeff();
}

StageError stage_error(const Trajectory& trajectory, const Trajectory& reference) {
  StageError error{.configuration = largest_distance(trajectory.stage_q, reference.stage_q),
                   .momentum = largest_distance(trajectory.stage_p, reference.stage_p)};
  if (trajectory.stage_psi_q.rows() > 0 && reference.stage_psi_q.rows() > 0) {
    error.costate_q = largest_distance(trajectory.stage_psi_q, reference.stage_psi_q);
    error.costate_p = largest_distance(trajectory.stage_psi_p, reference.stage_psi_p);
  }
  return error;
}

bool has_same_stages(const Trajectory& trajectory, const Trajectory& reference) {
  return trajectory.stage_p.rows() > 0 && trajectory.stage_p.rows() == reference.stage_p.rows() &&
         trajectory.stage_times == reference.stage_times;
}

}  // namespace

TrajectoryError trajectory_error(const Trajectory& trajectory, const Trajectory& reference) {
  TrajectoryError error;
  const bool compare_costates = trajectory.has_costates() && reference.has_costates();
  if (compare_costates) error.costate = 0.0;
  const bool has_first_order = trajectory.y.cols() > 0 && reference.y.cols() == trajectory.y.cols();
  const auto raise = [](std::optional<double>& largest, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    largest = std::max(largest.value_or(0.0), (a - b).norm());
  };
  const auto horizon = [](const Trajectory& motion) { return motion.node_times[motion.intervals()]; };
  const double stretch = horizon(reference) / horizon(trajectory);
  for (Eigen::Index k = 0; k < trajectory.node_times.size(); ++k) {
    const double t = trajectory.node_times[k] * stretch;
    const auto node = node_at(reference.node_times, t);
    const Eigen::VectorXd q =
        node ? Eigen::VectorXd(reference.q.row(*node).transpose()) : configuration_at(reference, t);
    error.state = std::max(error.state, (trajectory.q.row(k).transpose() - q).norm());
    if (!node) continue;
    if (has_first_order) raise(error.first_order, trajectory.y.row(k), reference.y.row(*node));
    if (has_first_order && compare_costates) {
      raise(error.first_order_costate, trajectory.psi_y.row(k), reference.psi_y.row(*node));
    }
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
        reference_control_at(reference, trajectory.stage_times[i] * stretch, ends_interval ? Side::left : Side::right);
    error.control = std::max(error.control, (trajectory.stage_u.row(i).transpose() - u).norm());
  }
  if (has_same_stages(trajectory, reference)) error.stages = stage_error(trajectory, reference);
  error.objective = std::abs(trajectory.cost - reference.cost);
  return error;
}

}  // namespace dmocbench
