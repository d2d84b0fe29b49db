#include "methods/transcription/bound_prices.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "methods/judgement/kkt_residual.hpp"

namespace dmocbench {

namespace {

/// Looks up the prices of a program's unknowns and rows.
class Prices {
 public:
  Prices(Transcription& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers)
      : program_(program),
        layout_(program.layout()),
        multipliers_(multipliers),
        steps_(program.steps(primal)),
        nodes_(static_cast<Eigen::Index>(layout_.intervals()) + 1) {
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
  /// Of a series of the nodes, into a column; 0 at ends where the value is given.
  void write_nodes(std::size_t head, Eigen::Ref<Eigen::VectorXd> column) const {
    for (Eigen::Index k = 0; k < nodes_; ++k) column[k] = of_node(head + static_cast<std::size_t>(k), k);
  }
  /// Of one unknown at node k.
  [[nodiscard]] double of_node(std::size_t number, Eigen::Index k) const {
    const auto i = static_cast<Eigen::Index>(number);
    const bool is_given = (k == 0 || k + 1 == nodes_) && program_.variable_lower()[i] == program_.variable_upper()[i];
    return is_given ? 0.0 : of_unknown(number);
  }
  /// Of a control of stage `stage`, per unit of time, for all intervals.
  [[nodiscard]] Eigen::VectorXd of_control(Eigen::Index stage, Eigen::Index i) const {
    const Eigen::VectorXd& b = program_.tableau().b;
    const bool is_first = stage == 0;
    const bool is_shared = layout_.shape().shares_controls && (is_first || stage + 1 == layout_.stages());
    Eigen::VectorXd prices(steps_.size());
    for (Eigen::Index k = 0; k < prices.size(); ++k) {
      double weight = steps_[k] * b[stage];
      const Eigen::Index neighbour = is_first ? k - 1 : k + 1;
      if (is_shared && neighbour >= 0 && neighbour < steps_.size()) weight += steps_[neighbour] * b[stage];
      prices[k] = of_unknown(layout_.control_head(stage, i) + static_cast<std::size_t>(k)) / weight;
    }
    return prices;
  }
  /// Of the i-th path row of a stage, per unit of time, for all intervals.
  [[nodiscard]] Eigen::VectorXd of_path_row(Eigen::Index stage, Eigen::Index i) const {
    const LayoutShape& shape = layout_.shape();
    const Eigen::Index row = shape.stage_equations + stage * (shape.path_rows / shape.stages) + i;
    const auto head = static_cast<Eigen::Index>(layout_.interval_row_head(row));
    return -multipliers_.segment(head, steps_.size())
                .cwiseQuotient(program_.cost_scale() * program_.tableau().b[stage] * steps_);
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  const Transcription& program_;
  const Layout& layout_;
  const Eigen::VectorXd& multipliers_;
  Eigen::VectorXd steps_;
  Eigen::Index nodes_;
  Eigen::VectorXd gradient_;  // of ℓ
};

/// Whether bounds leave an end open.
bool is_open(const Bounds& end) { return end.any() && !end.all_fixed(); }

/// Tables of zeros for all that is bounded, of the right sizes.
BoundPrices tables_for(const Transcription& program) {
  const ProblemBounds& bounds = program.bounds();
  const LayoutShape& shape = program.layout().shape();
  const auto intervals = static_cast<Eigen::Index>(shape.intervals);
  const Eigen::Index stages = intervals * shape.stages;
  const auto at_node = [&](Bounds EndBounds::*end, Bounds InteriorBounds::*interior) {
    return is_open(bounds.first.*end) || is_open(bounds.last.*end) ||
           std::ranges::any_of(bounds.interior, [&](const InteriorBounds& at) { return (at.*interior).any(); });
  };
  const auto bounded_velocities = std::ssize(bounds.bounded_velocities());
  BoundPrices tables;
  if (bounds.q.any() || at_node(&EndBounds::q, &InteriorBounds::q)) {
    tables.q.setZero(intervals + 1, shape.configuration_size);
  }
  if (at_node(&EndBounds::v, &InteriorBounds::v)) tables.v.setZero(intervals + 1, shape.configuration_size);
  if (bounds.y.any() || at_node(&EndBounds::y, &InteriorBounds::y)) {
    tables.y.setZero(intervals + 1, shape.first_order_size);
  }
  const bool has_controls_at_stages = program.functions().controls.has_times_of(program.tableau());
  if (bounds.u.any() && has_controls_at_stages) tables.stage_u.setZero(stages, shape.control_size);
  if (bounded_velocities > 0) tables.stage_v.setZero(stages, shape.configuration_size);
  tables.path.setZero(stages, shape.path_rows / shape.stages - bounded_velocities);
  tables.unknowns.setZero(shape.unknown_parameters);
  return tables;
}

bool has_entries(const BoundPrices& tables) {
  return tables.q.size() + tables.v.size() + tables.y.size() + tables.stage_v.size() + tables.stage_u.size() +
             tables.path.size() + tables.unknowns.size() >
         0;
}

/// Of bounds of q̇ at the ends and between them.
void write_velocities(const Prices& prices, const Layout& layout, Eigen::MatrixXd& v) {
  const LayoutShape& shape = layout.shape();
  const auto last = static_cast<Eigen::Index>(layout.intervals());
  for (Eigen::Index i = 0; i < v.cols(); ++i) {
    if (layout.node_state() == NodeState::velocity) prices.write_nodes(layout.second_head(i), v.col(i));
    if (shape.first_has_velocity) v(0, i) = prices.of_node(layout.first_velocity(i), 0);
    if (shape.last_has_velocity) v(last, i) = prices.of_node(layout.last_velocity(i), last);
    for (std::size_t j = 0; j < shape.interior_velocities.size(); ++j) {
      const auto node = static_cast<Eigen::Index>(shape.interior_velocities[j]);
      v(node, i) = prices.of_node(layout.interior_velocity(static_cast<Eigen::Index>(j), i), node);
    }
  }
}

void write_nodes(const Prices& prices, const Layout& layout, BoundPrices& result) {
  for (Eigen::Index i = 0; i < result.q.cols(); ++i) prices.write_nodes(layout.configuration_head(i), result.q.col(i));
  write_velocities(prices, layout, result.v);
  for (Eigen::Index i = 0; i < result.y.cols(); ++i) prices.write_nodes(layout.first_order_head(i), result.y.col(i));
}

void write_stages(const Prices& prices, const Layout& layout, const std::vector<Eigen::Index>& velocities,
                  BoundPrices& result) {
  const Eigen::Index s = layout.stages();
  const auto bounded = std::ssize(velocities);
  for (Eigen::Index stage = 0; stage < s; ++stage) {
    const auto rows = Eigen::seqN(stage, static_cast<Eigen::Index>(layout.intervals()), s);
    for (Eigen::Index i = 0; i < result.stage_u.cols(); ++i) result.stage_u(rows, i) = prices.of_control(stage, i);
    for (Eigen::Index i = 0; i < bounded; ++i) {
      result.stage_v(rows, velocities[static_cast<std::size_t>(i)]) = prices.of_path_row(stage, i);
    }
    for (Eigen::Index i = 0; i < result.path.cols(); ++i) {
      result.path(rows, i) = prices.of_path_row(stage, bounded + i);
    }
  }
}

}  // namespace

BoundPrices bound_prices(Transcription& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers) {
  const Layout& layout = program.layout();
  BoundPrices result = tables_for(program);
  if (!has_entries(result) && !program.has_free_horizon()) return result;
  const Prices prices(program, primal, multipliers);
  write_nodes(prices, layout, result);
  write_stages(prices, layout, program.bounds().bounded_velocities(), result);
  for (Eigen::Index i = 0; i < result.unknowns.size(); ++i) {
    result.unknowns[i] = prices.of_unknown(layout.unknown_parameter(i));
  }
  if (program.has_free_horizon()) result.horizon = prices.of_unknown(layout.horizon());
  return result;
}

}  // namespace dmocbench
