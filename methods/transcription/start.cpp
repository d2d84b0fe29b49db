#include "methods/transcription/start.hpp"

#include <algorithm>
#include <optional>
#include <ranges>
#include <utility>

#include "methods/error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/fitted_forces.hpp"

namespace dmocbench {

namespace {

/// The tables of a motion in the unknowns of a program. `stage_v` has a row per stage of `Element::rates`, `stage_u` of
/// `Element::controls`; `second_rates` has Ṗ_i or V̇_i, a row per stage. Costs so far and multipliers are 0.
Eigen::VectorXd unknowns_of(const Transcription& transcription, const Trajectory& motion,
                            const Eigen::MatrixXd& second_rates) {
  const Eigen::Index intervals = motion.q.rows() - 1;
  const Eigen::MatrixXd& second = transcription.node_state() == NodeState::momentum ? motion.p : motion.v;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(transcription.variable_count()));
  const auto set_nodes = [&](const UnknownBlock& block, const Eigen::MatrixXd& table) {
    for (Eigen::Index i = 0; i < block.width; ++i) x.segment(block.index(i), intervals + 1) = table.col(i);
  };
  /// From a table with the stages of a tableau.
  const auto set_stage = [&](const UnknownBlock& block, const Tableau& tableau, const Eigen::MatrixXd& table) {
    const auto rows = Eigen::seqN(block.stage, intervals, tableau.stages());
    for (Eigen::Index i = 0; i < block.width; ++i) x.segment(block.index(i), intervals) = table(rows, i);
  };
  // Where neighbours share a control, the first stage's is taken, which therefore comes last.
  for (const UnknownBlock& block : std::views::reverse(transcription.blocks().interval_unknowns())) {
    if (block.kind == Quantity::rate) set_stage(block, transcription.functions().rates, motion.stage_v);
    if (block.kind == Quantity::second_rate) set_stage(block, transcription.functions().rates, second_rates);
    if (block.kind == Quantity::first_order_rate) set_stage(block, motion.tableau, motion.stage_y_rates);
    if (block.kind == Quantity::control) set_stage(block, transcription.functions().controls, motion.stage_u);
  }
  for (const UnknownBlock& block : transcription.blocks().unknowns()) {
    if (block.kind == Quantity::configuration) set_nodes(block, motion.q);
    if (block.kind == Quantity::second) set_nodes(block, second);
    if (block.kind == Quantity::first_order) set_nodes(block, motion.y);
    if (block.kind == Quantity::velocity) {
      x.segment(block.index(), block.width) = motion.v.row(static_cast<Eigen::Index>(block.node)).transpose();
    }
    if (block.kind == Quantity::parameter) x.segment(block.index(), block.width) = motion.unknowns;
    if (block.kind == Quantity::horizon) x[block.index()] = motion.node_times[intervals];
  }
  return x;
}

Eigen::VectorXd guessed_unknowns(const Transcription& transcription) {
  const std::vector<std::size_t> numbers = transcription.problem().unknowns();
  return transcription.parameter_values()(std::vector<Eigen::Index>(numbers.begin(), numbers.end()));
}

/// Gives the point of an end node the components that the problem gives: those that constraints determine are
/// free in the program.
void move_to_end(const Transcription& transcription, Eigen::Index k, MotionPoint& point) {
  const bool is_first = k == 0;
  if (!is_first && k < static_cast<Eigen::Index>(transcription.blocks().intervals())) return;
  const EndBounds& end = is_first ? transcription.bounds().first : transcription.bounds().last;
  for (Eigen::Index i = 0; i < point.q.size(); ++i) {
    if (end.q.is_fixed(i)) point.q[i] = end.q.lower[i];
    if (end.v.is_fixed(i)) point.v[i] = end.v.lower[i];
  }
}

/// A motion in the tables that `unknowns_of` takes, of a program with horizon T.
Trajectory tables_of(const Transcription& transcription, const Motion& motion, double horizon) {
  const double stretch = motion.horizon / horizon;
  const auto point_at = [&](double t) {
    MotionPoint point = motion.at(t * stretch);
    point.v *= stretch;
    return point;
  };
  const TracedProblem& problem = transcription.traced_problem();
  const Eigen::Index n = problem.configuration_size();
  const Eigen::VectorXd widths = horizon * transcription.grid().relative_widths();
  Trajectory tables;
  tables.tableau = transcription.tableau();
  tables.unknowns =
      motion.unknowns.size() == problem.unknown_count() ? motion.unknowns : guessed_unknowns(transcription);
  tables.node_times = horizon * transcription.grid().relative_times();
  for (Eigen::MatrixXd* table : {&tables.q, &tables.p, &tables.v}) table->setZero(tables.node_times.size(), n);
  tables.y.resize(tables.node_times.size(), problem.first_order_size());
  std::optional<LegendreTransform> legendre;  // where nodes carry momenta
  if (transcription.node_state() == NodeState::momentum) legendre.emplace(problem);
  for (Eigen::Index k = 0; k < tables.node_times.size(); ++k) {
    MotionPoint node = point_at(tables.node_times[k]);
    if (problem.constraint_count() > 0) move_to_end(transcription, k, node);
    tables.q.row(k) = node.q.transpose();
    tables.v.row(k) = node.v.transpose();
    if (node.y.size() > 0) tables.y.row(k) = node.y.transpose();
    if (!legendre) continue;
    tables.p.row(k) = legendre->momentum(node.q, node.v, tables.node_times[k], node.y).transpose();
  }
  tables.stage_y_rates.setZero(widths.size() * tables.stages(), problem.first_order_size());
  const Tableau& rates = transcription.functions().rates;
  const Tableau& controls = transcription.functions().controls;
  tables.stage_v.resize(widths.size() * rates.stages(), n);
  tables.stage_u.resize(widths.size() * controls.stages(), problem.control_size());
  const auto visit = [&](const Tableau& tableau, auto&& keep) {
    const Eigen::Index s = tableau.stages();
    for (Eigen::Index row = 0; row < widths.size() * s; ++row) {
      keep(row, point_at(tables.node_times[row / s] + tableau.c[row % s] * widths[row / s]));
    }
  };
  const bool is_together = controls.has_times_of(rates);
  visit(rates, [&](Eigen::Index row, const MotionPoint& stage) {
    tables.stage_v.row(row) = stage.v.transpose();
    if (is_together) tables.stage_u.row(row) = stage.u.transpose();
  });
  if (is_together) return tables;
  visit(controls, [&](Eigen::Index row, const MotionPoint& stage) { tables.stage_u.row(row) = stage.u.transpose(); });
  return tables;
}

/// Sets interior rates of p or v and of y to the mean rates of their intervals, of which there is one per entry of
/// `widths`.
void set_mean_rates(const ProgramBlocks& blocks, const Eigen::VectorXd& widths, Eigen::VectorXd& x) {
  for (const UnknownBlock& rates : blocks.unknowns()) {
    if (rates.kind != Quantity::second_rate && rates.kind != Quantity::first_order_rate) continue;
    const UnknownBlock& states =
        blocks.unknown(rates.kind == Quantity::second_rate ? Quantity::second : Quantity::first_order);
    for (Eigen::Index i = 0; i < rates.width; ++i) {
      const auto nodes = x.segment(states.index(i), widths.size() + 1);
      x.segment(rates.index(i), widths.size()) =
          (nodes.tail(widths.size()) - nodes.head(widths.size())).cwiseQuotient(widths);
    }
  }
}

/// Sets the cost and the integrals so far such that their equations hold.
void add_up(Transcription& transcription, Eigen::VectorXd& x) {
  const ProgramBlocks& blocks = transcription.blocks();
  const auto intervals = static_cast<Eigen::Index>(blocks.intervals());
  const auto for_each_sum = [&](const auto& visit) {
    for (const auto& [kind, equation] :
         {std::pair(Quantity::cost, Equation::cost), std::pair(Quantity::integral, Equation::integral)}) {
      const UnknownBlock& sums = blocks.unknown(kind);
      for (Eigen::Index i = 0; i < sums.width; ++i) {
        visit(x.segment(sums.index(i), intervals + 1), blocks.row(equation).index(i));
      }
    }
  };
  for_each_sum([](auto sum, Eigen::Index /*row*/) { sum.setZero(); });
  Eigen::VectorXd constraints(static_cast<Eigen::Index>(transcription.constraint_count()));
  transcription.constraints(x, constraints);  // z_{k+1} - z_k less the interval's part, with every z = 0
  for_each_sum([&](auto sum, Eigen::Index row) {
    for (Eigen::Index k = 0; k < intervals; ++k) sum[k + 1] = sum[k] - constraints[row + k];
  });
}

/// The values at the stages of a tableau of the polynomials through a stage table of a trajectory.
Eigen::MatrixXd at_stages_of(const Tableau& tableau, const Trajectory& trajectory, const Eigen::MatrixXd& stages) {
  if (tableau.has_times_of(trajectory.tableau)) return stages;
  const Eigen::Index intervals = trajectory.intervals();
  Eigen::MatrixXd table = Eigen::MatrixXd::Zero(intervals * tableau.stages(), stages.cols());
  for (Eigen::Index i = 0; i < tableau.stages(); ++i) {
    const Eigen::VectorXd weights = lagrange_basis(trajectory.tableau.c, tableau.c[i]);
    for (Eigen::Index j = 0; j < weights.size(); ++j) {
      table(Eigen::seqN(i, intervals, tableau.stages()), Eigen::all) +=
          weights[j] * stages(Eigen::seqN(j, intervals, weights.size()), Eigen::all);
    }
  }
  return table;
}

void require_same_grid(const Transcription& transcription, const Trajectory& trajectory) {
  const Eigen::VectorXd& times = trajectory.node_times;
  const double horizon = transcription.has_free_horizon() ? times[times.size() - 1] : transcription.guessed_horizon();
  const Eigen::VectorXd& relative = transcription.grid().relative_times();
  const bool same_size = times.size() == relative.size() && trajectory.stages() == transcription.tableau().stages();
  if (!same_size || times != horizon * relative) {
    throw Error("a trajectory can be embedded only in a transcription with the same grid and tableau");
  }
}

/// Ṗ_i or V̇_i at all stages, in the order of the trajectory's stage tables.
Eigen::MatrixXd second_rates(const Problem& problem, NodeState node_state, const Trajectory& trajectory) {
  if (node_state == NodeState::configuration) return {};
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  const TracedProblem traced(problem);
  EquationsOfMotion motion(traced);
  PointFunction force(traced, [&](const ControlledState& x) { return traced.at(x).generalised_force; });
  Eigen::MatrixXd rates(trajectory.stage_q.rows(), trajectory.stage_q.cols());
  Eigen::VectorXd rate(rates.cols());
  for (Eigen::Index row = 0; row < rates.rows(); ++row) {
    const MotionPoint stage = trajectory.stage(row);
    if (node_state == NodeState::momentum) {
      force.evaluate(stage, trajectory.stage_times[row], rate);
    } else {
      rate = motion.acceleration(stage.q, stage.v, stage.u, trajectory.stage_times[row], stage.y);
    }
    rates.row(row) = rate.transpose();
  }
  return rates;
}

}  // namespace

Eigen::VectorXd sample(Transcription& transcription, const Motion& motion) {
  const ProgramBlocks& blocks = transcription.blocks();
  const Eigen::VectorXd& lower = transcription.variable_lower();
  const Eigen::VectorXd& upper = transcription.variable_upper();
  double horizon = transcription.guessed_horizon();
  if (transcription.has_free_horizon()) {
    const Eigen::Index place = blocks.unknown(Quantity::horizon).index();
    horizon = std::clamp(motion.horizon, lower[place], upper[place]);
  }
  const Trajectory tables = tables_of(transcription, motion, horizon);
  Eigen::VectorXd x = unknowns_of(transcription, tables, Eigen::MatrixXd::Zero(tables.stage_v.rows(), tables.q.cols()));
  x = x.cwiseMax(lower).cwiseMin(upper);
  set_mean_rates(blocks, horizon * transcription.grid().relative_widths(), x);
  if (transcription.functions().multipliers > 0) fit_forces(transcription, FittedForces::controls, x);
  if (blocks.unknown(Quantity::cost).width + blocks.unknown(Quantity::integral).width > 0) add_up(transcription, x);
  return x.cwiseMax(lower).cwiseMin(upper);
}

Motion guessed_motion(const Problem& problem) {
  return {[&problem](double t) { return problem.guess(t); }, problem.horizon()};
}

Motion guessed_motion(const Transcription& program) {
  return {[&program](double t) {
            const ParameterScope scope = program.parameter_scope();
            return program.problem().guess(t);
          },
          program.guessed_horizon()};
}

Eigen::VectorXd embed(const Problem& problem, Transcription& transcription, const Trajectory& trajectory) {
  require_same_grid(transcription, trajectory);
  const NodeState node_state = transcription.node_state();
  Trajectory tables = trajectory;
  tables.stage_v = at_stages_of(transcription.functions().rates, trajectory, trajectory.stage_v);
  tables.stage_u = at_stages_of(transcription.functions().controls, trajectory, trajectory.stage_u);
  Eigen::VectorXd x = unknowns_of(transcription, tables, second_rates(problem, node_state, trajectory));
  // The forces of constraint, and stage rates, which contain them.
  if (transcription.functions().multipliers > 0) fit_forces(transcription, FittedForces::second_rates, x);
  return x;
}

}  // namespace dmocbench
