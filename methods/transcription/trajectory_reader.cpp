#include "methods/transcription/trajectory_reader.hpp"

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/transcription/bound_multipliers.hpp"
#include "methods/transcription/costates.hpp"
#include "methods/transcription/motions/velocities_of_momenta.hpp"

namespace dmocbench {

namespace {

/// The forced discrete Legendre transforms at all nodes.
Eigen::MatrixXd read_momenta(Transcription& transcription, const Eigen::VectorXd& primal, Eigen::Index n) {
  const Eigen::MatrixXd sides = transcription.tabulate(transcription.functions().momenta, primal);
  Eigen::MatrixXd p(sides.rows() + 1, n);
  p.topRows(sides.rows()) = sides.leftCols(n);
  p.row(sides.rows()) = sides.row(sides.rows() - 1).rightCols(n);
  return p;
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

/// The series of a block, a column per component.
Eigen::MatrixXd table_of(const UnknownBlock& block, const Eigen::VectorXd& primal, Eigen::Index length) {
  Eigen::MatrixXd table(length, block.width);
  for (Eigen::Index i = 0; i < block.width; ++i) table.col(i) = primal.segment(block.index(i), length);
  return table;
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
    throw Error(fmt::format("a trajectory needs {} variables, got {}", transcription.variable_count(), primal.size()));
  }
  const ProgramBlocks& blocks = transcription.blocks();
  const Eigen::Index n = transcription.traced_problem().configuration_size();
  Trajectory trajectory;
  trajectory.tableau = transcription.tableau();
  trajectory.node_times = transcription.node_times(primal);
  const Eigen::Index nodes = trajectory.node_times.size();
  trajectory.q = table_of(blocks.unknown(Quantity::configuration), primal, nodes);
  trajectory.y = table_of(blocks.unknown(Quantity::first_order), primal, nodes);
  trajectory.integrals = table_of(blocks.unknown(Quantity::integral), primal, nodes).bottomRows(1).transpose();
  trajectory.unknowns = transcription.unknown_parameters(primal);
  transcription.set_unknown_parameters(trajectory.unknowns);
  trajectory.p = read_momenta(transcription, primal, n);
  read_stages(transcription, primal, trajectory);
  const Eigen::MatrixXd raw_momenta = trajectory.p;
  add_velocities(transcription.traced_problem(), trajectory);
  trajectory.cost = transcription.objective(primal) / transcription.cost_scale();
  if (static_cast<std::size_t>(multipliers.size()) == transcription.constraint_count()) {
    Costates psi = costates(transcription, primal, multipliers, trajectory.v);
    if (transcription.functions().multipliers > 0) {
      move_to_projected_momenta(transcription.traced_problem(), raw_momenta - trajectory.p, trajectory, psi);
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
