#include "methods/transcription/sample_multipliers.hpp"

#include <algorithm>
#include <limits>

#include "methods/error.hpp"
#include "methods/judgement/kkt_residual.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/derivatives/point_derivatives.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/start.hpp"

namespace dmocbench {

namespace {

/// A point of a motion with its costates.
struct AdjointPoint {
  MotionPoint motion;
  Eigen::VectorXd psi_q;
  Eigen::VectorXd psi_p;
  Eigen::VectorXd psi_y;  // l entries
};

/// The rates of ψ^p, ψ^q and ψ^y where `at_point` was evaluated last: -∂H/∂p, -∂H/∂q and -∂H/∂y (methods/README.md).
struct CostateRates {
  Eigen::VectorXd psi_p;
  Eigen::VectorXd psi_q;
  Eigen::VectorXd psi_y;

  CostateRates(const PointDerivatives& at_point, const AdjointPoint& point)
      : psi_p(-solve_square(at_point.mass(), Eigen::VectorXd(at_point.cost_by_velocity() + point.psi_q +
                                                             at_point.force_by_velocity().transpose() * point.psi_p +
                                                             at_point.rates_by_velocity().transpose() * point.psi_y))),
        psi_q(-at_point.cost_by_configuration() - at_point.force_by_configuration().transpose() * point.psi_p -
              at_point.momentum_by_configuration().transpose() * psi_p -
              at_point.rates_by_configuration().transpose() * point.psi_y),
        psi_y(-at_point.cost_by_first_order() - at_point.force_by_first_order().transpose() * point.psi_p -
              at_point.momentum_by_first_order().transpose() * psi_p -
              at_point.rates_by_first_order().transpose() * point.psi_y) {}
};

/// ψ^q, ψ^p and ψ^y, over time, as the configuration of a motion.
Motion costate_curve(PointDerivatives& at_point, const Trajectory& trajectory) {
  const Eigen::Index n = trajectory.q.cols();
  const Eigen::Index l = trajectory.psi_y.cols();
  Trajectory curve = trajectory;
  curve.q.resize(trajectory.q.rows(), 2 * n + l);
  curve.q << trajectory.psi_q, trajectory.psi_p, trajectory.psi_y;
  curve.v.resize(trajectory.q.rows(), 2 * n + l);
  for (Eigen::Index k = 0; k < curve.q.rows(); ++k) {
    AdjointPoint point{trajectory.node(k), trajectory.psi_q.row(k).transpose(), trajectory.psi_p.row(k).transpose(),
                       Trajectory::row_of(trajectory.psi_y, k)};
    point.motion.u = control_at(trajectory, trajectory.node_times[k]);
    at_point.evaluate(point.motion, trajectory.node_times[k]);
    const CostateRates rates(at_point, point);
    curve.v.row(k) << rates.psi_q.transpose(), rates.psi_p.transpose(), rates.psi_y.transpose();
  }
  return smooth_motion(curve);
}

/// A trajectory with its costates at the nodes and stages of a program.
class SampledCostates {
 public:
  SampledCostates(const Transcription& program, const Trajectory& trajectory, PointDerivatives& at_point,
                  double horizon)
      : trajectory_(trajectory),
        motion_(smooth_motion(trajectory)),
        costates_(costate_curve(at_point, trajectory)),
        stretch_(motion_.horizon / horizon),
        has_same_stages_(trajectory.has_stage_costates() &&
                         program.functions().rates.has_times_of(trajectory.tableau) &&
                         trajectory.node_times == horizon * program.grid().relative_times()) {}

  /// At row `row` of the program's stages whose rates are unknowns, at time t.
  [[nodiscard]] AdjointPoint stage(Eigen::Index row, double t) const {
    if (!has_same_stages_) return at(t);
    return {trajectory_.stage(row), trajectory_.stage_psi_q.row(row).transpose(),
            trajectory_.stage_psi_p.row(row).transpose(), Trajectory::row_of(trajectory_.stage_psi_y, row)};
  }
  [[nodiscard]] AdjointPoint at(double t) const {
    AdjointPoint point{motion_.at(t * stretch_), {}, {}, {}};
    point.motion.v *= stretch_;
    const Eigen::VectorXd psi = costates_.at(t * stretch_).q;
    const Eigen::Index n = point.motion.q.size();
    point.psi_q = psi.head(n);
    point.psi_p = psi.segment(n, n);
    point.psi_y = psi.tail(psi.size() - 2 * n);
    return point;
  }

 private:
  const Trajectory& trajectory_;
  Motion motion_;
  Motion costates_;
  double stretch_;
  bool has_same_stages_;
};

/// Writes the multipliers of the rows that costates determine, for the true cost.
class MultiplierWriter {
 public:
  MultiplierWriter(const Layout& layout, Eigen::Index n, Eigen::VectorXd& multipliers)
      : layout_(layout), n_(n), multipliers_(multipliers) {}

  void write_node(Eigen::Index k, const Eigen::VectorXd& psi_p) {
    for (Eigen::Index i = 0; i < n_; ++i) at(layout_.node_row_head(i), k) = psi_p[i];
  }
  /// The `block`-th n rows of interval k.
  void write_interval(Eigen::Index block, Eigen::Index k, const Eigen::VectorXd& values) {
    for (Eigen::Index i = 0; i < n_; ++i) at(layout_.interval_row_head(block * n_ + i), k) = values[i];
  }
  /// The rows Ẏ_i - g of stage i in interval k.
  void write_first_order(Eigen::Index i, Eigen::Index k, const Eigen::VectorXd& values) {
    const Eigen::Index l = values.size();
    const Eigen::Index first = layout_.shape().stage_equations - (layout_.stages() - i) * l;
    for (Eigen::Index j = 0; j < l; ++j) at(layout_.interval_row_head(first + j), k) = values[j];
  }
  /// z_{k+1} - z_k - cost = 0 carries the cost from node to node.
  void write_costs(double value) {
    const auto head = static_cast<Eigen::Index>(layout_.sum_row_head(0));
    multipliers_.segment(head, static_cast<Eigen::Index>(layout_.intervals())).setConstant(value);
  }
  /// Every integral is carried alike; its multipliers are the price of its bound.
  void write_integrals(const Eigen::VectorXd& prices) {
    const LayoutShape& shape = layout_.shape();
    for (Eigen::Index i = 0; i < prices.size(); ++i) {
      const auto head = static_cast<Eigen::Index>(layout_.sum_row_head(shape.sums() - shape.integrals + i));
      multipliers_.segment(head, static_cast<Eigen::Index>(layout_.intervals())).setConstant(prices[i]);
    }
  }
  /// The rows p - L_v(q, v) of the ends that have them: stationarity in p.
  void write_ties(const Eigen::VectorXd& first, const Eigen::VectorXd& last) {
    std::size_t row = 0;
    const auto write = [&](bool is_there, const Eigen::VectorXd& values) {
      if (!is_there) return;
      for (Eigen::Index i = 0; i < n_; ++i) at(layout_.end_row_places()[row++].first, 0) = values[i];
    };
    write(layout_.shape().first_has_velocity, -first);
    write(layout_.shape().last_has_velocity, last);
  }

 private:
  double& at(std::size_t head, Eigen::Index k) { return multipliers_[static_cast<Eigen::Index>(head) + k]; }

  const Layout& layout_;
  Eigen::Index n_;
  Eigen::VectorXd& multipliers_;
};

double horizon_of(const Transcription& program, double of_motion) {
  if (!program.has_free_horizon()) return program.guessed_horizon();
  const auto place = static_cast<Eigen::Index>(program.layout().horizon());
  return std::clamp(of_motion, program.variable_lower()[place], program.variable_upper()[place]);
}

void write_stage(const SampledCostates& sampled, PointDerivatives& at_point, NodeState family, Eigen::Index row,
                 double t, Eigen::Index stages, double weight, MultiplierWriter& writer) {
  const Eigen::Index k = row / stages;
  const Eigen::Index i = row % stages;
  const AdjointPoint point = sampled.stage(row, t);
  writer.write_first_order(i, k, -weight * point.psi_y);
  if (family == NodeState::configuration && i + 1 == stages) return;  // the last stage rate is eliminated
  at_point.evaluate(point.motion, t);
  if (family == NodeState::velocity) {
    writer.write_interval(2 * i, k,
                          -weight * (point.psi_q + at_point.momentum_by_configuration().transpose() * point.psi_p));
    writer.write_interval(2 * i + 1, k, -weight * point.psi_p);
    return;
  }
  const Eigen::VectorXd rate = CostateRates(at_point, point).psi_p;
  if (family == NodeState::configuration) {
    writer.write_interval(i, k, weight * rate);
  } else {
    writer.write_interval(2 * i, k, -weight * rate);
    writer.write_interval(2 * i + 1, k, -weight * point.psi_p);
  }
}

/// The equations (x_{k+1} - Φ)/h of shooting: -h times the costate of (q, v) at node k + 1.
void write_shooting(const SampledCostates& sampled, PointDerivatives& at_point, const Eigen::VectorXd& times,
                    MultiplierWriter& writer) {
  for (Eigen::Index k = 0; k + 1 < times.size(); ++k) {
    const double h = times[k + 1] - times[k];
    const AdjointPoint point = sampled.at(times[k + 1]);
    at_point.evaluate(point.motion, times[k + 1]);
    writer.write_interval(0, k, -h * (point.psi_q + at_point.momentum_by_configuration().transpose() * point.psi_p));
    writer.write_interval(1, k, -h * (at_point.mass() * point.psi_p));
  }
}

}  // namespace

Eigen::VectorXd sample_multipliers(Transcription& program, const Trajectory& trajectory) {
  if (!trajectory.has_costates() || trajectory.psi_y.cols() != program.traced_problem().first_order_size()) {
    throw Error("multipliers can only be sampled from a trajectory with costates");
  }
  program.traced_problem().require_no_constraints("the start from costates");
  const Layout& layout = program.layout();
  const NodeState family = layout.node_state();
  const Motion motion = smooth_motion(trajectory);
  const double horizon = horizon_of(program, motion.horizon);
  const Eigen::VectorXd times = horizon * program.grid().relative_times();
  const Eigen::VectorXd widths = horizon * program.grid().relative_widths();
  PointDerivatives at_point(program.traced_problem(), trajectory.integral_prices);
  const SampledCostates sampled(program, trajectory, at_point, horizon);

  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd multipliers =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(program.constraint_count()), unknown);
  MultiplierWriter writer(layout, trajectory.q.cols(), multipliers);
  if (family == NodeState::configuration) {
    for (Eigen::Index k = 0; k < times.size(); ++k) writer.write_node(k, sampled.at(times[k]).psi_p);
  }
  const Tableau& rates = program.functions().rates;
  const Eigen::Index s = rates.stages();
  const bool has_stages = program.functions().has_stage_unknowns;
  if (!has_stages) write_shooting(sampled, at_point, times, writer);
  for (Eigen::Index row = 0; has_stages && row < widths.size() * s; ++row) {
    const Eigen::Index k = row / s;
    const Eigen::Index i = row % s;
    write_stage(sampled, at_point, family, row, times[k] + rates.c[i] * widths[k], s, widths[k] * rates.b[i], writer);
  }
  if (layout.shape().mayer) writer.write_costs(-1.0 / program.cost_scale());  // z is the scaled cost
  if (trajectory.integral_prices.size() == layout.shape().integrals) writer.write_integrals(trajectory.integral_prices);
  if (family == NodeState::momentum) {
    writer.write_ties(sampled.at(0.0).psi_p, sampled.at(horizon).psi_p);
  }
  multipliers *= program.cost_scale();
  return complete_multipliers(program, sample(program, motion), multipliers);
}

}  // namespace dmocbench
