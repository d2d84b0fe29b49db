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

/// Whether the equations of an interval with nodes q collocate, which need more rates than stages, or are variations.
bool collocates(const Transcription& program) {
  return program.functions().rates.stages() > program.tableau().stages();
}

/// The stages of the equations of an interval: where the rates are unknowns, unless the equations collocate.
const Tableau& stages_of_equations(const Transcription& program) {
  return collocates(program) ? program.tableau() : program.functions().rates;
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
                         stages_of_equations(program).has_times_of(trajectory.tableau) &&
                         trajectory.node_times == horizon * program.grid().relative_times()) {}

  /// At row `row` of the stages of the program's equations, at time t.
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
  MultiplierWriter(const ProgramBlocks& blocks, Eigen::VectorXd& multipliers)
      : blocks_(blocks), multipliers_(multipliers) {}

  /// The rows of a stage, or of none, for interval or node k; nothing where the program has no such rows.
  void write(Equation kind, Eigen::Index stage, Eigen::Index k, const Eigen::VectorXd& values) {
    write(blocks_.row(kind, stage), k, values);
  }
  /// The rows that tie the velocity of an end to its momentum.
  void write_tie(std::size_t node, const Eigen::VectorXd& values) {
    write(blocks_.row_at(Equation::momentum, node), 0, values);
  }
  /// The same values for all intervals.
  void write_all(Equation kind, const Eigen::VectorXd& values) {
    for (std::size_t k = 0; k < blocks_.intervals(); ++k) {
      write(blocks_.row(kind), static_cast<Eigen::Index>(k), values);
    }
  }

 private:
  void write(const RowBlock& block, Eigen::Index k, const Eigen::VectorXd& values) {
    for (Eigen::Index i = 0; i < block.width; ++i) multipliers_[block.index(i) + k] = values[i];
  }

  const ProgramBlocks& blocks_;
  Eigen::VectorXd& multipliers_;
};

double horizon_of(const Transcription& program, double of_motion) {
  if (!program.has_free_horizon()) return program.guessed_horizon();
  const Eigen::Index place = program.blocks().unknown(Quantity::horizon).index();
  return std::clamp(of_motion, program.variable_lower()[place], program.variable_upper()[place]);
}

void write_stage(const SampledCostates& sampled, PointDerivatives& at_point, NodeState family, Eigen::Index row,
                 double t, Eigen::Index stages, double h, double b, bool has_variations, MultiplierWriter& writer) {
  const Eigen::Index k = row / stages;
  const Eigen::Index i = row % stages;
  const AdjointPoint point = sampled.stage(row, t);
  const double weight = h * b;
  const double of_equation = family == NodeState::configuration ? b : weight;  // has the factor h itself, or not
  writer.write(Equation::first_order, i, k, -of_equation * point.psi_y);
  if (has_variations && i + 1 == stages) return;  // the last stage rate is eliminated
  if (!has_variations) writer.write(Equation::euler_lagrange, i, k, -of_equation * point.psi_p);
  at_point.evaluate(point.motion, t);
  if (family == NodeState::velocity) {
    writer.write(Equation::velocity, i, k,
                 -weight * (point.psi_q + at_point.momentum_by_configuration().transpose() * point.psi_p));
    return;
  }
  const Eigen::VectorXd rate = CostateRates(at_point, point).psi_p;
  if (has_variations) writer.write(Equation::euler_lagrange, i, k, weight * rate);
  if (family == NodeState::momentum) writer.write(Equation::momentum, i, k, -weight * rate);
}

/// The equations (x_{k+1} - Φ)/h of shooting: -h times the costate of (q, v) at node k + 1.
void write_shooting(const SampledCostates& sampled, PointDerivatives& at_point, const Eigen::VectorXd& times,
                    MultiplierWriter& writer) {
  for (Eigen::Index k = 0; k + 1 < times.size(); ++k) {
    const double h = times[k + 1] - times[k];
    const AdjointPoint point = sampled.at(times[k + 1]);
    at_point.evaluate(point.motion, times[k + 1]);
    writer.write(Equation::motion, no_stage, k,
                 -h * (point.psi_q + at_point.momentum_by_configuration().transpose() * point.psi_p));
    writer.write(Equation::second_motion, no_stage, k, -h * (at_point.mass() * point.psi_p));
  }
}

}  // namespace

Eigen::VectorXd sample_multipliers(Transcription& program, const Trajectory& trajectory) {
  if (!trajectory.has_costates() || trajectory.psi_y.cols() != program.traced_problem().first_order_size()) {
    throw Error("multipliers can be sampled only from a trajectory with costates");
  }
  program.traced_problem().require_no_constraints("starting from costates");
  const NodeState family = program.node_state();
  const Motion motion = smooth_motion(trajectory);
  const double horizon = horizon_of(program, motion.horizon);
  const Eigen::VectorXd times = horizon * program.grid().relative_times();
  const Eigen::VectorXd widths = horizon * program.grid().relative_widths();
  PointDerivatives at_point(program.traced_problem(), trajectory.integral_prices);
  const SampledCostates sampled(program, trajectory, at_point, horizon);

  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd multipliers =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(program.constraint_count()), unknown);
  MultiplierWriter writer(program.blocks(), multipliers);
  if (family == NodeState::configuration) {
    for (Eigen::Index k = 0; k < times.size(); ++k) {
      writer.write(Equation::euler_lagrange, no_stage, k, sampled.at(times[k]).psi_p);
    }
  }
  const Tableau& stages = stages_of_equations(program);
  const bool has_variations = family == NodeState::configuration && !collocates(program);
  const Eigen::Index s = stages.stages();
  const bool has_stages = program.functions().has_stage_unknowns;
  if (!has_stages) write_shooting(sampled, at_point, times, writer);
  for (Eigen::Index row = 0; has_stages && row < widths.size() * s; ++row) {
    const Eigen::Index k = row / s;
    const Eigen::Index i = row % s;
    write_stage(sampled, at_point, family, row, times[k] + stages.c[i] * widths[k], s, widths[k], stages.b[i],
                has_variations, writer);
  }
  // z_{k+1} - z_k - cost = 0 carries the scaled cost from node to node, and integrals likewise.
  writer.write_all(Equation::cost, Eigen::VectorXd::Constant(1, -1.0 / program.cost_scale()));
  if (trajectory.integral_prices.size() == program.traced_problem().integral_count()) {
    writer.write_all(Equation::integral, trajectory.integral_prices);
  }
  writer.write_tie(0, -sampled.at(0.0).psi_p);
  writer.write_tie(program.blocks().intervals(), sampled.at(horizon).psi_p);
  multipliers *= program.cost_scale();
  return complete_multipliers(program, sample(program, motion), multipliers);
}

}  // namespace dmocbench
