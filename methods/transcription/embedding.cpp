#include "methods/transcription/embedding.hpp"

#include "methods/error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/point_function.hpp"

namespace dmocbench {

namespace {

void require_same_grid(const Transcription& transcription, const Trajectory& trajectory) {
  const Eigen::VectorXd& times = trajectory.node_times;
  const double horizon = transcription.has_free_horizon() ? times[times.size() - 1] : transcription.guessed_horizon();
  const Eigen::VectorXd& relative = transcription.grid().relative_times();
  const bool same_size = times.size() == relative.size() && trajectory.stages() == transcription.tableau().stages();
  if (!same_size || times != horizon * relative) {
    throw Error("a trajectory can only be embedded in a transcription with the same grid and tableau");
  }
}

/// Ṗ_i or V̇_i at all stages, in the order of the trajectory's stage tables.
Eigen::MatrixXd second_rates(const Problem& problem, NodeState node_state, const Trajectory& trajectory) {
  const TracedProblem traced(problem);
  EquationsOfMotion motion(traced);
  PointFunction force(traced.configuration_size(), traced.control_size(),
                      [&](const ControlledState& x) { return traced.at(x).generalised_force; });
  Eigen::MatrixXd rates(trajectory.stage_q.rows(), trajectory.stage_q.cols());
  Eigen::VectorXd rate(rates.cols());
  for (Eigen::Index row = 0; row < rates.rows(); ++row) {
    const MotionPoint stage = trajectory.stage(row);
    if (node_state == NodeState::momentum) {
      force.evaluate(stage, trajectory.stage_times[row], rate);
    } else {
      rate = motion.acceleration(stage.q, stage.v, stage.u, trajectory.stage_times[row]);
    }
    rates.row(row) = rate.transpose();
  }
  return rates;
}

}  // namespace

Eigen::VectorXd embed(const Problem& problem, const Transcription& transcription, const Trajectory& trajectory) {
  require_same_grid(transcription, trajectory);
  const Layout& layout = transcription.layout();
  const NodeState node_state = layout.node_state();
  const Eigen::Index nodes = trajectory.q.rows();
  const Eigen::Index s = trajectory.stages();
  Eigen::VectorXd x(static_cast<Eigen::Index>(transcription.variable_count()));
  const auto set_column = [&](std::size_t column, const auto& values) {
    x.segment(static_cast<Eigen::Index>(column), values.size()) = values;
  };
  /// Column c of a stage table, of stage i alone.
  const auto stage_column = [&](const Eigen::MatrixXd& table, Eigen::Index i, Eigen::Index c) -> Eigen::VectorXd {
    return table(Eigen::seqN(i, nodes - 1, s), c);
  };
  for (Eigen::Index c = 0; c < trajectory.q.cols(); ++c) {
    set_column(layout.configuration_column(c), trajectory.q.col(c));
    for (Eigen::Index i = 0; i < layout.interior_stages(); ++i) {
      set_column(layout.slope_q_column(i, c), stage_column(trajectory.stage_v, i, c));
    }
  }
  for (Eigen::Index c = 0; c < trajectory.stage_u.cols(); ++c) {
    for (Eigen::Index i = 0; i < s; ++i) {
      set_column(layout.control_column(i, c), stage_column(trajectory.stage_u, i, c));
    }
  }
  for (Eigen::Index i = 0; i < trajectory.v.cols(); ++i) {
    if (layout.shape().first_has_velocity) x[static_cast<Eigen::Index>(layout.first_velocity(i))] = trajectory.v(0, i);
    if (layout.shape().last_has_velocity) {
      x[static_cast<Eigen::Index>(layout.last_velocity(i))] = trajectory.v(nodes - 1, i);
    }
  }
  if (transcription.has_free_horizon()) {
    x[static_cast<Eigen::Index>(layout.horizon())] = trajectory.node_times[nodes - 1];
  }
  if (node_state == NodeState::configuration) return x;
  const Eigen::MatrixXd rates = second_rates(problem, node_state, trajectory);
  const Eigen::MatrixXd& second = node_state == NodeState::momentum ? trajectory.p : trajectory.v;
  for (Eigen::Index c = 0; c < second.cols(); ++c) {
    set_column(layout.second_column(c), second.col(c));
    for (Eigen::Index i = 0; i < layout.interior_stages(); ++i) {
      set_column(layout.slope_y_column(i, c), stage_column(rates, i, c));
    }
  }
  return x;
}

}  // namespace dmocbench
