#include "methods/transcription/bound_multipliers.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "methods/judgement/kkt_residual.hpp"

namespace dmocbench {

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

}  // namespace dmocbench
