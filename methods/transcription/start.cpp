#include "methods/transcription/start.hpp"

#include <algorithm>

#include "methods/mechanics/legendre_transform.hpp"

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
      entry(layout_->slope_q_column(stage, i), k) = at_stage.v[i];
      if (layout_->node_state() == NodeState::configuration) continue;
      const std::size_t column = layout_->second_column(i);
      entry(layout_->slope_y_column(stage, i), k) = (entry(column, k + 1) - entry(column, k)) / h;
    }
  }

  /// Sets the cost so far such that the equations of the Mayer form hold.
  void sum_costs() {
    Eigen::VectorXd rows(static_cast<Eigen::Index>(transcription_->constraint_count()));
    transcription_->constraints(x_, rows);  // z_{k+1} - z_k - cost, with every z = 0
    const std::size_t row = layout_->private_row_column(layout_->shape().interval_rows() - 1);
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

}  // namespace

Eigen::VectorXd sample(Transcription& transcription, const Motion& motion) {
  return Sampler(transcription, motion).sampled();
}

Motion guessed_motion(const Problem& problem) {
  return {[&problem](double t) { return problem.guess(t); }, problem.horizon()};
}

}  // namespace dmocbench
