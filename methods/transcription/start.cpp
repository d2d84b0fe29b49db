#include "methods/transcription/start.hpp"

#include <algorithm>
#include <optional>

#include "methods/error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/numerics/lagrange_basis.hpp"
#include "methods/transcription/fitted_forces.hpp"

namespace dmocbench {

namespace {

/// The tables of a motion in the unknowns of a program. `stage_v` has a row per stage of `Element::rates`, `stage_u` of
/// `Element::controls`; `second_rates` has Ṗ_i or V̇_i, a row per stage. Costs so far are 0.
Eigen::VectorXd unknowns_of(const Transcription& transcription, const Trajectory& motion,
                            const Eigen::MatrixXd& second_rates) {
  const Layout& layout = transcription.layout();
  const Eigen::Index nodes = motion.q.rows();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(transcription.variable_count()));
  const auto set = [&](std::size_t column, const auto& values) {
    x.segment(static_cast<Eigen::Index>(column), values.size()) = values;
  };
  /// The rows of stage i in a table with the stages of a tableau.
  const auto rows_of = [&](const Tableau& tableau, Eigen::Index i) {
    return Eigen::seqN(i, nodes - 1, tableau.stages());
  };
  const Tableau& rates = transcription.functions().rates;
  const Tableau& controls = transcription.functions().controls;
  const bool has_second = layout.node_state() != NodeState::configuration;
  const Eigen::MatrixXd& second = layout.node_state() == NodeState::momentum ? motion.p : motion.v;
  for (Eigen::Index c = 0; c < motion.q.cols(); ++c) {
    set(layout.configuration_head(c), motion.q.col(c));
    if (has_second) set(layout.second_head(c), second.col(c));
    for (Eigen::Index i = 0; i < layout.interior_stages(); ++i) {
      set(layout.rate_head(i, c), motion.stage_v(rows_of(rates, i), c));
      if (has_second) set(layout.second_rate_head(i, c), second_rates(rows_of(rates, i), c));
    }
  }
  for (Eigen::Index c = 0; c < motion.y.cols(); ++c) {
    set(layout.first_order_head(c), motion.y.col(c));
    for (Eigen::Index i = 0; i < layout.interior_first_order_stages(); ++i) {
      set(layout.first_order_rate_head(i, c), motion.stage_y_rates(rows_of(motion.tableau, i), c));
    }
  }
  for (Eigen::Index c = 0; c < motion.stage_u.cols(); ++c) {
    // Where neighbours share a control, the first stage's is taken.
    for (Eigen::Index i = controls.stages() - 1; i >= 0; --i) {
      set(layout.control_head(i, c), motion.stage_u(rows_of(controls, i), c));
    }
  }
  if (layout.shape().first_has_velocity) set(layout.first_velocity(0), motion.v.row(0).transpose());
  if (layout.shape().last_has_velocity) set(layout.last_velocity(0), motion.v.row(nodes - 1).transpose());
  const std::vector<std::size_t>& velocities = layout.shape().interior_velocities;
  for (std::size_t j = 0; j < velocities.size(); ++j) {
    set(layout.interior_velocity(static_cast<Eigen::Index>(j), 0),
        motion.v.row(static_cast<Eigen::Index>(velocities[j])).transpose());
  }
  if (transcription.has_free_horizon()) set(layout.horizon(), motion.node_times.tail<1>());
  if (motion.unknowns.size() > 0) set(layout.unknown_parameter(0), motion.unknowns);
  return x;
}

Eigen::VectorXd guessed_unknowns(const Transcription& transcription) {
  const std::vector<std::size_t> numbers = transcription.problem().unknowns();
  return transcription.parameter_values()(std::vector<Eigen::Index>(numbers.begin(), numbers.end()));
}

/// Gives the point of an end node the components that the problem gives: those that holonomic constraints determine are
/// free in the program.
void move_to_end(const Transcription& transcription, Eigen::Index k, MotionPoint& point) {
  const bool is_first = k == 0;
  if (!is_first && k < static_cast<Eigen::Index>(transcription.layout().intervals())) return;
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
  if (transcription.layout().node_state() == NodeState::momentum) legendre.emplace(problem);
  for (Eigen::Index k = 0; k < tables.node_times.size(); ++k) {
    MotionPoint node = point_at(tables.node_times[k]);
    if (problem.holonomic_count() > 0) move_to_end(transcription, k, node);
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
void set_mean_rates(const Layout& layout, const Eigen::VectorXd& widths, Eigen::VectorXd& x) {
  const auto set = [&](std::size_t nodes_head, Eigen::Index stages, const auto& rate_head) {
    const auto nodes = x.segment(static_cast<Eigen::Index>(nodes_head), widths.size() + 1);
    const Eigen::VectorXd rates = (nodes.tail(widths.size()) - nodes.head(widths.size())).cwiseQuotient(widths);
    for (Eigen::Index i = 0; i < stages; ++i) {
      x.segment(static_cast<Eigen::Index>(rate_head(i)), widths.size()) = rates;
    }
  };
  const LayoutShape& shape = layout.shape();
  for (Eigen::Index c = 0; layout.node_state() != NodeState::configuration && c < shape.configuration_size; ++c) {
    set(layout.second_head(c), layout.interior_stages(), [&](Eigen::Index i) { return layout.second_rate_head(i, c); });
  }
  for (Eigen::Index c = 0; c < shape.first_order_size; ++c) {
    set(layout.first_order_head(c), layout.interior_first_order_stages(),
        [&](Eigen::Index i) { return layout.first_order_rate_head(i, c); });
  }
}

/// Sets the cost and the integrals so far such that their equations hold.
void add_up(Transcription& transcription, Eigen::VectorXd& x) {
  const Layout& layout = transcription.layout();
  const auto intervals = static_cast<Eigen::Index>(layout.intervals());
  const auto sum_of = [&](Eigen::Index i) {
    return x.segment(static_cast<Eigen::Index>(layout.sum_head(i)), intervals + 1);
  };
  for (Eigen::Index i = 0; i < layout.shape().sums(); ++i) sum_of(i).setZero();
  Eigen::VectorXd constraints(static_cast<Eigen::Index>(transcription.constraint_count()));
  transcription.constraints(x, constraints);  // z_{k+1} - z_k less the interval's part, with every z = 0
  for (Eigen::Index i = 0; i < layout.shape().sums(); ++i) {
    const auto row = static_cast<Eigen::Index>(layout.sum_row_head(i));
    for (Eigen::Index k = 0; k < intervals; ++k) sum_of(i)[k + 1] = sum_of(i)[k] - constraints[row + k];
  }
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
    throw Error("a trajectory can only be embedded in a transcription with the same grid and tableau");
  }
}

/// Ṗ_i or V̇_i at all stages, in the order of the trajectory's stage tables.
Eigen::MatrixXd second_rates(const Problem& problem, NodeState node_state, const Trajectory& trajectory) {
  if (node_state == NodeState::configuration) return {};
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  const TracedProblem traced(problem);
  EquationsOfMotion motion(traced);
  PointFunction force(
      traced.configuration_size(), traced.control_size(),
      [&](const ControlledState& x) { return traced.at(x).generalised_force; }, traced.first_order_size());
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
  const Layout& layout = transcription.layout();
  const Eigen::VectorXd& lower = transcription.variable_lower();
  const Eigen::VectorXd& upper = transcription.variable_upper();
  double horizon = transcription.guessed_horizon();
  if (transcription.has_free_horizon()) {
    const auto place = static_cast<Eigen::Index>(layout.horizon());
    horizon = std::clamp(motion.horizon, lower[place], upper[place]);
  }
  const Trajectory tables = tables_of(transcription, motion, horizon);
  Eigen::VectorXd x = unknowns_of(transcription, tables, Eigen::MatrixXd::Zero(tables.stage_v.rows(), tables.q.cols()));
  x = x.cwiseMax(lower).cwiseMin(upper);
  set_mean_rates(layout, horizon * transcription.grid().relative_widths(), x);
  if (layout.shape().multipliers > 0) fit_forces(transcription, FittedForces::controls, x);
  if (layout.shape().sums() > 0) add_up(transcription, x);
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
  const NodeState node_state = transcription.layout().node_state();
  Trajectory tables = trajectory;
  tables.stage_v = at_stages_of(transcription.functions().rates, trajectory, trajectory.stage_v);
  tables.stage_u = at_stages_of(transcription.functions().controls, trajectory, trajectory.stage_u);
  Eigen::VectorXd x = unknowns_of(transcription, tables, second_rates(problem, node_state, trajectory));
  // The forces of constraint, and stage rates, which contain them.
  if (transcription.layout().shape().multipliers > 0) fit_forces(transcription, FittedForces::second_rates, x);
  return x;
}

}  // namespace dmocbench
