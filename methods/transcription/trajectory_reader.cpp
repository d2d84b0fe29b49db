#include "methods/transcription/trajectory_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "methods/error.hpp"
#include "methods/judgement/kkt_residual.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/transcription/costates.hpp"

namespace dmocbench {

void add_velocities(const TracedProblem& problem, Trajectory& trajectory) {
  LegendreTransform legendre(problem);
  trajectory.stage_p.resizeLike(trajectory.stage_q);
  for (Eigen::Index i = 0; i < trajectory.stage_p.rows(); ++i) {
    const MotionPoint stage = trajectory.stage(i);
    trajectory.stage_p.row(i) = legendre.momentum(stage.q, stage.v, trajectory.stage_times[i], stage.y).transpose();
  }
  trajectory.v.resizeLike(trajectory.q);
  for (Eigen::Index k = 0; k < trajectory.v.rows(); ++k) {
    const Eigen::Index nearby = std::min(k * trajectory.stages(), trajectory.stage_v.rows() - 1);
    trajectory.v.row(k) =
        legendre
            .velocity(trajectory.q.row(k).transpose(), trajectory.p.row(k).transpose(), trajectory.node_times[k],
                      trajectory.stage_v.row(nearby).transpose(), Trajectory::row_of(trajectory.y, k))
            .transpose();
    if (problem.constraint_count() == 0) continue;
    const MotionPoint node = trajectory.node(k);
    trajectory.p.row(k) = legendre.momentum(node.q, node.v, trajectory.node_times[k], node.y).transpose();
  }
}

namespace {

/// Looks up the prices of a program's unknowns and rows.
class Prices {
 public:
  Prices(Transcription& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers)
      : program_(program), multipliers_(multipliers), steps_(program.steps(primal)), nodes_(steps_.size() + 1) {
    KktMemory memory;
    evaluate_kkt(program, primal, multipliers, memory);
    gradient_ = std::move(memory.gradient);
  }

  /// Of an unknown: 0 where it has no bound.
  [[nodiscard]] double of_unknown(std::size_t number) const {
    const auto i = static_cast<Eigen::Index>(number);
    const bool is_bounded = std::max(program_.variable_lower()[i], -program_.variable_upper()[i]) > -infinite;
    return is_bounded ? gradient_[i] / program_.cost_scale() : 0.0;
  }
  /// Of a block of the nodes, into as many columns; 0 at ends where the value is given.
  void write_nodes(const UnknownBlock& block, Eigen::MatrixXd& table) const {
    for (Eigen::Index i = 0; i < table.cols(); ++i) {
      for (Eigen::Index k = 0; k < nodes_; ++k) table(k, i) = of_node(block.at(i) + static_cast<std::size_t>(k), k);
    }
  }
  /// Of one unknown at node k.
  [[nodiscard]] double of_node(std::size_t number, Eigen::Index k) const {
    const auto i = static_cast<Eigen::Index>(number);
    const bool is_given = (k == 0 || k + 1 == nodes_) && program_.variable_lower()[i] == program_.variable_upper()[i];
    return is_given ? 0.0 : of_unknown(number);
  }
  /// Of component i of the controls of a stage, per unit of time, for all intervals.
  [[nodiscard]] Eigen::VectorXd of_control(Eigen::Index stage, Eigen::Index i) const {
    const Eigen::VectorXd& b = program_.tableau().b;
    const UnknownBlock& controls = program_.blocks().unknown(Quantity::control, stage);
    const bool is_shared = controls.support == Support::nodes;
    Eigen::VectorXd prices(steps_.size());
    for (Eigen::Index k = 0; k < prices.size(); ++k) {
      double weight = steps_[k] * b[stage];
      const Eigen::Index neighbour = stage == 0 ? k - 1 : k + 1;
      if (is_shared && neighbour >= 0 && neighbour < steps_.size()) weight += steps_[neighbour] * b[stage];
      prices[k] = of_unknown(controls.at(i) + static_cast<std::size_t>(k)) / weight;
    }
    return prices;
  }
  /// Of component i of rows of a stage, per unit of time, for all intervals.
  [[nodiscard]] Eigen::VectorXd of_row(const RowBlock& rows, Eigen::Index i = 0) const {
    return -multipliers_.segment(rows.index(i), steps_.size())
                .cwiseQuotient(program_.cost_scale() * program_.tableau().b[rows.stage] * steps_);
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  const Transcription& program_;
  const Eigen::VectorXd& multipliers_;
  Eigen::VectorXd steps_;
  Eigen::Index nodes_;
  Eigen::VectorXd gradient_;  // of ℓ
};

/// Whether bounds leave an end open.
bool is_open(const Bounds& end) { return end.any() && !end.all_fixed(); }

/// Tables of zeros for all that is bounded, of the right sizes.
BoundMultipliers tables_for(const Transcription& program) {
  const ProblemBounds& bounds = program.bounds();
  const TracedProblem& traced = program.traced_problem();
  const Eigen::Index n = traced.configuration_size();
  const auto intervals = static_cast<Eigen::Index>(program.blocks().intervals());
  const Eigen::Index stages = intervals * program.tableau().stages();
  const auto at_node = [&](Bounds EndBounds::*end, Bounds InteriorBounds::*interior) {
    return is_open(bounds.first.*end) || is_open(bounds.last.*end) ||
           std::ranges::any_of(bounds.interior, [&](const InteriorBounds& at) { return (at.*interior).any(); });
  };
  BoundMultipliers tables;
  if (bounds.q.any() || at_node(&EndBounds::q, &InteriorBounds::q)) tables.q.setZero(intervals + 1, n);
  if (at_node(&EndBounds::v, &InteriorBounds::v)) tables.v.setZero(intervals + 1, n);
  if (bounds.y.any() || at_node(&EndBounds::y, &InteriorBounds::y)) {
    tables.y.setZero(intervals + 1, traced.first_order_size());
  }
  const bool has_controls_at_stages = program.functions().controls.has_times_of(program.tableau());
  if (bounds.u.any() && has_controls_at_stages) tables.stage_u.setZero(stages, traced.control_size());
  if (!bounds.bounded_velocities().empty()) tables.stage_v.setZero(stages, n);
  tables.path.setZero(stages, traced.path_constraint_count());
  tables.unknowns.setZero(traced.unknown_count());
  return tables;
}

bool has_entries(const BoundMultipliers& tables) {
  return tables.q.size() + tables.v.size() + tables.y.size() + tables.stage_v.size() + tables.stage_u.size() +
             tables.path.size() + tables.unknowns.size() >
         0;
}

/// Of the rows and controls of all stages.
void write_stages(const Prices& prices, const Transcription& program, BoundMultipliers& result) {
  const auto intervals = static_cast<Eigen::Index>(program.blocks().intervals());
  const Eigen::Index s = program.tableau().stages();
  const auto rows_of = [&](Eigen::Index stage) { return Eigen::seqN(stage, intervals, s); };
  for (Eigen::Index stage = 0; stage < s; ++stage) {
    for (Eigen::Index i = 0; i < result.stage_u.cols(); ++i) {
      result.stage_u(rows_of(stage), i) = prices.of_control(stage, i);
    }
  }
  for (const RowBlock& block : program.blocks().rows()) {
    if (block.kind == Equation::bounded_velocity) {
      result.stage_v(rows_of(block.stage), block.component) = prices.of_row(block);
    }
    if (block.kind != Equation::path) continue;
    for (Eigen::Index i = 0; i < block.width; ++i) result.path(rows_of(block.stage), i) = prices.of_row(block, i);
  }
}

}  // namespace

BoundMultipliers bound_multipliers(Transcription& program, const Eigen::VectorXd& primal,
                                   const Eigen::VectorXd& multipliers) {
  BoundMultipliers result = tables_for(program);
  if (!has_entries(result) && !program.has_free_horizon()) return result;
  const Prices prices(program, primal, multipliers);
  const ProgramBlocks& blocks = program.blocks();
  prices.write_nodes(blocks.unknown(Quantity::configuration), result.q);
  prices.write_nodes(blocks.unknown(Quantity::first_order), result.y);
  if (program.node_state() == NodeState::velocity) prices.write_nodes(blocks.unknown(Quantity::second), result.v);
  for (const UnknownBlock& block : blocks.unknowns()) {
    if (block.kind != Quantity::velocity || result.v.size() == 0) continue;
    const auto node = static_cast<Eigen::Index>(block.node);
    for (Eigen::Index i = 0; i < block.width; ++i) result.v(node, i) = prices.of_node(block.at(i), node);
  }
  write_stages(prices, program, result);
  const UnknownBlock& parameters = blocks.unknown(Quantity::parameter);
  for (Eigen::Index i = 0; i < parameters.width; ++i) result.unknowns[i] = prices.of_unknown(parameters.at(i));
  if (program.has_free_horizon()) result.horizon = prices.of_unknown(blocks.unknown(Quantity::horizon).at());
  return result;
}

namespace {

/// The forced discrete Legendre transforms at all nodes, and impulses, which `move_impulses` completes.
void read_momenta(Transcription& transcription, const Eigen::VectorXd& primal, Eigen::Index n, Trajectory& trajectory) {
  const Eigen::MatrixXd sides = transcription.tabulate(transcription.functions().momenta, primal);
  trajectory.p.resize(sides.rows() + 1, n);
  trajectory.p.topRows(sides.rows()) = sides.leftCols(n);
  trajectory.p.row(sides.rows()) = sides.row(sides.rows() - 1).middleCols(n, n);
  if (sides.cols() == 2 * n) return;
  trajectory.left_impulses = sides.middleCols(2 * n, n);
  trajectory.right_impulses = sides.middleCols(3 * n, n);
  const Eigen::Index s = sides.cols() / n - 4;  // stages with forces of constraint
  trajectory.stage_constraint_forces.resize(sides.rows() * s, n);
  for (Eigen::Index i = 0; i < s; ++i) {
    trajectory.stage_constraint_forces(Eigen::seqN(i, sides.rows(), s), Eigen::all) = sides.middleCols((4 + i) * n, n);
  }
}

/// From the momenta of the intervals, larger by `gaps`, to the projected ones.
void move_impulses(const Eigen::MatrixXd& gaps, Trajectory& trajectory) {
  if (trajectory.left_impulses.size() == 0) return;
  trajectory.left_impulses += gaps.topRows(trajectory.intervals());
  trajectory.right_impulses -= gaps.bottomRows(trajectory.intervals());
}

void read_stages(Transcription& transcription, const Eigen::VectorXd& primal, Trajectory& trajectory) {
  const Eigen::Index n = transcription.traced_problem().configuration_size();
  const Eigen::Index m = transcription.traced_problem().control_size();
  const Eigen::Index s = transcription.tableau().stages();
  const Eigen::MatrixXd table = transcription.tabulate(transcription.functions().stages, primal);
  const Eigen::Index intervals = table.rows();
  trajectory.stage_times.resize(intervals * s);
  trajectory.stage_q.resize(intervals * s, n);
  trajectory.stage_v.resize(intervals * s, n);
  trajectory.stage_u.resize(intervals * s, m);
  const Eigen::Index l = transcription.traced_problem().first_order_size();
  trajectory.stage_y.resize(intervals * s, l);
  trajectory.stage_y_rates.resize(intervals * s, l);
  const Eigen::Index width = 2 * n + 1 + m + 2 * l;
  for (Eigen::Index i = 0; i < s; ++i) {
    const auto rows = Eigen::seqN(i, intervals, s);
    const auto stage = table.middleCols(i * width, width);
    trajectory.stage_q(rows, Eigen::all) = stage.leftCols(n);
    trajectory.stage_v(rows, Eigen::all) = stage.middleCols(n, n);
    trajectory.stage_times(rows) = stage.col(2 * n);
    trajectory.stage_u(rows, Eigen::all) = stage.middleCols(2 * n + 1, m);
    trajectory.stage_y(rows, Eigen::all) = stage.middleCols(2 * n + 1 + m, l);
    trajectory.stage_y_rates(rows, Eigen::all) = stage.rightCols(l);
  }
}

/// Takes whole turns out of leaps of a control without bounds that the formulas read as an angle: an answer may have
/// any number of turns at every stage, but the polynomial through its stages would sweep them.
void take_out_turns(const Transcription& transcription, Trajectory& trajectory) {
  constexpr double turn = 2.0 * std::numbers::pi;
  constexpr double rounding = 1e-9;
  const Bounds bounds = transcription.problem().bounds().u;
  const TracedProblem& traced = transcription.traced_problem();
  const Eigen::Index before_controls = 2 * trajectory.stage_q.cols();
  Eigen::MatrixXd rows(trajectory.stage_u.rows(),
                       before_controls + trajectory.stage_u.cols() + trajectory.stage_y.cols() + 1);
  Eigen::MatrixXd values;  // of the formulas at the stages
  for (Eigen::Index j = 0; j < trajectory.stage_u.cols(); ++j) {
    Eigen::VectorXd angle = trajectory.stage_u.col(j);
    for (Eigen::Index i = 1; i < angle.size(); ++i) angle[i] -= turn * std::round((angle[i] - angle[i - 1]) / turn);
    if (angle == trajectory.stage_u.col(j) || (bounds.any() && bounds.is_bounded(j))) continue;
    if (values.size() == 0) {
      rows << trajectory.stage_q, trajectory.stage_v, trajectory.stage_u, trajectory.stage_y, trajectory.stage_times;
      values = traced.table(rows);
    }
    rows.col(before_controls + j) = angle;
    const Eigen::MatrixXd turned = traced.table(rows);
    const bool is_angle = ((turned - values).array().abs() <= rounding * (1.0 + values.array().abs())).all();
    if (is_angle) trajectory.stage_u.col(j) = angle;
    rows.col(before_controls + j) = trajectory.stage_u.col(j);
  }
}

/// z_N = Σ h Σ b_i c is worth the multiplier of every row z_{k+1} - z_k - h Σ b_i c.
Eigen::VectorXd read_prices(const Transcription& transcription, const Eigen::VectorXd& multipliers) {
  const RowBlock& rows = transcription.blocks().row(Equation::integral);
  Eigen::VectorXd prices(rows.width);
  for (Eigen::Index i = 0; i < prices.size(); ++i) {
    prices[i] = multipliers[rows.index(i)] / transcription.cost_scale();
  }
  return prices;
}

}  // namespace

Trajectory read_trajectory(Transcription& transcription, const Eigen::VectorXd& primal,
                           const Eigen::VectorXd& multipliers) {
  if (static_cast<std::size_t>(primal.size()) != transcription.variable_count()) {
    throw Error("a trajectory needs {} variables, got {}", transcription.variable_count(), primal.size());
  }
  const ProgramBlocks& blocks = transcription.blocks();
  const Eigen::Index n = transcription.traced_problem().configuration_size();
  Trajectory trajectory;
  trajectory.tableau = transcription.tableau();
  trajectory.node_times = transcription.node_times(primal);
  const Eigen::Index nodes = trajectory.node_times.size();
  trajectory.q = blocks.unknown(Quantity::configuration).columns(primal, nodes);
  trajectory.y = blocks.unknown(Quantity::first_order).columns(primal, nodes);
  trajectory.integrals = blocks.unknown(Quantity::integral).columns(primal, nodes).bottomRows(1).transpose();
  trajectory.unknowns = transcription.unknown_parameters(primal);
  transcription.set_unknown_parameters(trajectory.unknowns);
  read_momenta(transcription, primal, n, trajectory);
  read_stages(transcription, primal, trajectory);
  take_out_turns(transcription, trajectory);
  const Eigen::MatrixXd raw_momenta = trajectory.p;
  add_velocities(transcription.traced_problem(), trajectory);
  const Eigen::MatrixXd gaps = raw_momenta - trajectory.p;
  move_impulses(gaps, trajectory);
  trajectory.cost = transcription.objective(primal) / transcription.cost_scale();
  if (static_cast<std::size_t>(multipliers.size()) == transcription.constraint_count()) {
    Costates psi = costates(transcription, primal, multipliers, trajectory.v);
    if (transcription.functions().multipliers > 0) {
      move_to_projected_momenta(transcription.traced_problem(), gaps, trajectory, psi);
    }
    trajectory.psi_q = std::move(psi.psi_q);
    trajectory.psi_p = std::move(psi.psi_p);
    trajectory.psi_y = std::move(psi.psi_y);
    trajectory.integral_prices = read_prices(transcription, multipliers);
    trajectory.prices = bound_multipliers(transcription, primal, multipliers);
    const IntervalFunctions& functions = transcription.functions();
    const bool has_stages = functions.has_stage_unknowns && functions.rates.has_times_of(trajectory.tableau) &&
                            functions.controls.has_times_of(trajectory.tableau);
    if (has_stages && functions.path_rows == 0 && functions.multipliers == 0 &&
        !transcription.traced_problem().has_embedding()) {
      StageCostates stages = stage_costates(transcription, multipliers, trajectory);
      trajectory.stage_psi_q = std::move(stages.psi_q);
      trajectory.stage_psi_p = std::move(stages.psi_p);
      trajectory.stage_psi_y = std::move(stages.psi_y);
    }
  }
  return trajectory;
}

}  // namespace dmocbench
