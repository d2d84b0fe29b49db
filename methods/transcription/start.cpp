#include "methods/transcription/start.hpp"

#include <algorithm>

#include "methods/error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/point_function.hpp"

namespace dmocbench {

namespace {

/// Writes a motion into the unknowns of a transcription, kind by kind.
class Sampler {
 public:
  Sampler(Transcription& transcription, const Motion& motion)
      : transcription_(&transcription),
        layout_(&transcription.layout()),
        motion_(&motion),
        legendre_(transcription.traced_problem()),
        horizon_(transcription.guessed_horizon()),
        x_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(transcription.variable_count()))) {
    if (transcription.has_free_horizon()) {
      const auto place = static_cast<Eigen::Index>(layout_->horizon());
      x_[place] =
          std::clamp(motion.horizon, transcription.variable_lower()[place], transcription.variable_upper()[place]);
      horizon_ = x_[place];
    }
  }

  Eigen::VectorXd sampled() {
    sample_nodes();
    move_into_bounds();
    sample_intervals();
    if (layout_->shape().mayer) sum_costs();
    move_into_bounds();
    return x_;
  }

 private:
  /// The motion at time t of the program.
  [[nodiscard]] MotionPoint point(double t) const {
    const double stretch = motion_->horizon / horizon_;
    MotionPoint point = motion_->at(t * stretch);
    point.v *= stretch;
    return point;
  }

  double& entry(std::size_t column, Eigen::Index k) { return x_[static_cast<Eigen::Index>(column) + k]; }

  void sample_nodes() {
    const Eigen::VectorXd times = horizon_ * transcription_->grid().relative_times();
    for (Eigen::Index k = 0; k < times.size(); ++k) {
      const MotionPoint node = point(times[k]);
      Eigen::VectorXd second = node.v;
      if (layout_->node_state() == NodeState::momentum) {
        second = legendre_.momentum(node.q, node.v, times[k]);
      }
      for (Eigen::Index i = 0; i < node.q.size(); ++i) {
        entry(layout_->configuration_column(i), k) = node.q[i];
        if (layout_->node_state() != NodeState::configuration) entry(layout_->second_column(i), k) = second[i];
        if (k == 0 && layout_->shape().first_has_velocity) entry(layout_->first_velocity(i), 0) = node.v[i];
        if (k + 1 == times.size() && layout_->shape().last_has_velocity)
          entry(layout_->last_velocity(i), 0) = node.v[i];
      }
    }
  }

  void sample_intervals() {
    const Eigen::VectorXd times = horizon_ * transcription_->grid().relative_times();
    const Eigen::VectorXd widths = horizon_ * transcription_->grid().relative_widths();
    const Eigen::VectorXd& c = transcription_->tableau().c;
    for (Eigen::Index k = 0; k < widths.size(); ++k) {
      for (Eigen::Index stage = 0; stage < c.size(); ++stage) {
        const MotionPoint at_stage = point(times[k] + c[stage] * widths[k]);
        for (Eigen::Index i = 0; i < at_stage.u.size(); ++i)
          entry(layout_->control_column(stage, i), k) = at_stage.u[i];
        if (stage < layout_->interior_stages()) sample_rates(at_stage, stage, k, widths[k]);
      }
    }
  }

  void sample_rates(const MotionPoint& at_stage, Eigen::Index stage, Eigen::Index k, double h) {
    for (Eigen::Index i = 0; i < at_stage.v.size(); ++i) {
      entry(layout_->rate_column(stage, i), k) = at_stage.v[i];
      if (layout_->node_state() == NodeState::configuration) continue;
      const std::size_t column = layout_->second_column(i);
      entry(layout_->second_rate_column(stage, i), k) = (entry(column, k + 1) - entry(column, k)) / h;
    }
  }

  /// Sets the cost so far such that the equations of the Mayer form hold.
  void sum_costs() {
    Eigen::VectorXd rows(static_cast<Eigen::Index>(transcription_->constraint_count()));
    transcription_->constraints(x_, rows);  // z_{k+1} - z_k - cost, with every z = 0
    const std::size_t row = layout_->interval_row_column(layout_->shape().interval_rows() - 1);
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(layout_->intervals()); ++k) {
      entry(layout_->cost_column(), k + 1) =
          entry(layout_->cost_column(), k) - rows[static_cast<Eigen::Index>(row) + k];
    }
  }

  void move_into_bounds() {
    x_ = x_.cwiseMax(transcription_->variable_lower()).cwiseMin(transcription_->variable_upper());
  }

  Transcription* transcription_;
  const Layout* layout_;
  const Motion* motion_;
  LegendreTransform legendre_;
  double horizon_;
  Eigen::VectorXd x_;
};

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

Eigen::VectorXd sample(Transcription& transcription, const Motion& motion) {
  return Sampler(transcription, motion).sampled();
}

Motion guessed_motion(const Problem& problem) {
  return {[&problem](double t) { return problem.guess(t); }, problem.horizon()};
}

Eigen::VectorXd embed(const Problem& problem, const Transcription& transcription, const Trajectory& trajectory) {
  require_same_grid(transcription, trajectory);
  const Layout& layout = transcription.layout();
  const NodeState node_state = layout.node_state();
  const Eigen::Index nodes = trajectory.q.rows();
  Eigen::VectorXd x(static_cast<Eigen::Index>(transcription.variable_count()));
  const auto set = [&](std::size_t column, const auto& values) {
    x.segment(static_cast<Eigen::Index>(column), values.size()) = values;
  };
  /// The rows of stage i in a stage table.
  const auto rows_of = [&](Eigen::Index i) { return Eigen::seqN(i, nodes - 1, trajectory.stages()); };
  for (Eigen::Index c = 0; c < trajectory.q.cols(); ++c) {
    set(layout.configuration_column(c), trajectory.q.col(c));
    for (Eigen::Index i = 0; i < layout.interior_stages(); ++i) {
      set(layout.rate_column(i, c), trajectory.stage_v(rows_of(i), c));
    }
  }
  for (Eigen::Index c = 0; c < trajectory.stage_u.cols(); ++c) {
    for (Eigen::Index i = 0; i < layout.stages(); ++i) {
      set(layout.control_column(i, c), trajectory.stage_u(rows_of(i), c));
    }
  }
  if (layout.shape().first_has_velocity) set(layout.first_velocity(0), trajectory.v.row(0).transpose());
  if (layout.shape().last_has_velocity) set(layout.last_velocity(0), trajectory.v.row(nodes - 1).transpose());
  if (transcription.has_free_horizon()) set(layout.horizon(), trajectory.node_times.tail<1>());
  if (node_state == NodeState::configuration) return x;
  const Eigen::MatrixXd rates = second_rates(problem, node_state, trajectory);
  const Eigen::MatrixXd& second = node_state == NodeState::momentum ? trajectory.p : trajectory.v;
  for (Eigen::Index c = 0; c < second.cols(); ++c) {
    set(layout.second_column(c), second.col(c));
    for (Eigen::Index i = 0; i < layout.interior_stages(); ++i) {
      set(layout.second_rate_column(i, c), rates(rows_of(i), c));
    }
  }
  return x;
}

}  // namespace dmocbench
