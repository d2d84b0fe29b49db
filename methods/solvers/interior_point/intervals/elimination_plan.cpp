#include "methods/solvers/interior_point/intervals/elimination_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Core>

namespace dmocbench::interior_point {

namespace {

/// Rows and columns in the order of elimination: position -> natural number.
struct Order {
  std::vector<int> rows;
  std::vector<int> columns;  // of Z
  std::vector<double> pivots;
};

/// Derivatives of the equalities of an interval with respect to Z.
Eigen::MatrixXd equalities_of(const IntervalEntries& entries, const NewtonArrays& arrays, std::size_t interval) {
  const Shape& shape = entries.shape;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(shape.rows, next_size(shape));
  for (const LocalEntry& entry : entries.local) {
    if (entry.block != LocalEntry::Block::equality || entry.column >= matrix.cols()) continue;
    matrix(entry.row, entry.column) = arrays.at(entry.source, entry.first + interval);
  }
  return matrix;
}

/// `columns_in_order`: the columns are taken as they stand, the first of them dependent.
std::optional<Order> find_order(Eigen::MatrixXd left, bool columns_in_order) {
  const auto numbers = [](Eigen::Index count) {
    std::vector<int> list(static_cast<std::size_t>(count));
    std::iota(list.begin(), list.end(), 0);
    return list;
  };
  Order order{numbers(left.rows()), numbers(left.cols()), {}};
  if (!left.allFinite()) return std::nullopt;
  Eigen::VectorXd row_scale = left.cwiseAbs().rowwise().maxCoeff();
  if (left.rows() > 0 && !(row_scale.minCoeff() > 0.0)) return std::nullopt;
  constexpr double smallest = 1e-12;  // of a row's largest entry: beyond it a pivot is rounding
  for (Eigen::Index p = 0; p < left.rows(); ++p) {
    // The largest entry of what is left, with every row measured by its own largest entry.
    const Eigen::Index height = left.rows() - p;
    const Eigen::Index width = columns_in_order ? 1 : left.cols() - p;
    Eigen::Index row = 0;
    Eigen::Index column = 0;
    (left.block(p, p, height, width).array().abs().colwise() / row_scale.tail(height).array()).maxCoeff(&row, &column);
    row += p;
    column += p;
    const double pivot = left(row, column);
    if (!(std::abs(pivot) > smallest * row_scale[row])) return std::nullopt;
    left.row(p).swap(left.row(row));
    left.col(p).swap(left.col(column));
    std::swap(row_scale[p], row_scale[row]);
    std::swap(order.rows[static_cast<std::size_t>(p)], order.rows[static_cast<std::size_t>(row)]);
    std::swap(order.columns[static_cast<std::size_t>(p)], order.columns[static_cast<std::size_t>(column)]);
    order.pivots.push_back(std::abs(pivot));
    for (Eigen::Index i = p + 1; i < left.rows(); ++i) left.row(i) -= left(i, p) / pivot * left.row(p);
  }
  return order;
}

/// True if the dependent unknowns are those of the next node.
bool determines_next_node(const Order& order, const Shape& shape) {
  if (shape.rows != shape.node) return false;
  return std::all_of(order.columns.begin(), order.columns.begin() + shape.rows,
                     [&](int column) { return column < shape.node; });
}

std::vector<int> inverse(const std::vector<int>& order) {
  std::vector<int> places(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) places[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  return places;
}

/// Natural numbers of rows and columns to entries of `LocalBlocks`.
class Slots {
 public:
  Slots(const Shape& shape, const Order& order)
      : blocks_{shape}, row_at_(inverse(order.rows)), next_at_(inverse(order.columns)) {}

  [[nodiscard]] int column(int natural) const {
    return natural < next_size(blocks_.shape) ? next_at_[static_cast<std::size_t>(natural)] : natural;
  }
  [[nodiscard]] int row(int natural) const { return row_at_[static_cast<std::size_t>(natural)]; }
  [[nodiscard]] const LocalBlocks<Shape>& blocks() const { return blocks_; }

  /// The slot of an entry, and that of its mirror image.
  [[nodiscard]] std::pair<int, int> of(const LocalEntry& entry) const {
    const int node = blocks_.shape.node;
    switch (entry.block) {
      case LocalEntry::Block::equality:
        return twice(blocks_.equalities()(row(entry.row), column(entry.column)));
      case LocalEntry::Block::carry:
        return twice(
            blocks_.carry()(entry.row, entry.column < node ? entry.column : node + column(entry.column - node)));
      case LocalEntry::Block::inequality:
        return twice(entry.column < 0 ? blocks_.compliance()(entry.row, 0)
                                      : blocks_.inequalities()(entry.row, column(entry.column)));
      case LocalEntry::Block::hessian:
        break;
    }
    const int slot = blocks_.hessian()(column(entry.row), column(entry.column));
    if (entry.column >= next_size(blocks_.shape)) return twice(slot);
    return {slot, blocks_.hessian()(column(entry.column), column(entry.row))};
  }

 private:
  static std::pair<int, int> twice(int slot) { return {slot, slot}; }

  LocalBlocks<Shape> blocks_;
  std::vector<int> row_at_;
  std::vector<int> next_at_;
};

void append_gathers(const IntervalEntries& entries, const Slots& slots, EliminationPlan& plan) {
  std::vector<bool> is_set(static_cast<std::size_t>(slots.blocks().size()), false);
  const auto append = [&](const LocalEntry& entry, bool from_before, int slot, int mirror) {
    const auto at = static_cast<std::size_t>(slot);
    plan.gathers.push_back({entry.source, is_set[at], from_before, entry.first, slot, mirror});
    is_set[at] = true;
  };
  for (const LocalEntry& entry : entries.local) {
    const auto [slot, mirror] = slots.of(entry);
    append(entry, false, slot, mirror);
  }
  // What the interval before has put into s_k beyond J_{k,k-1} x_{k-1} is taken back.
  for (const LocalEntry& entry : entries.local) {
    if (entry.block != LocalEntry::Block::carry || entry.column >= entries.shape.node) continue;
    if (!moves_by_increment(entries.shape, plan.node_in_next.data(), entry.column)) continue;
    const int slot = slots.blocks().equalities()(slots.row(entry.row), next_size(entries.shape) + entry.column);
    append(entry, true, slot, slot);
  }
}

/// The constants: s_k stands in the rows of its node as it is; a fixed unknown has a Hessian of its own.
void append_unit_entries(const IntervalEntries& entries, const Slots& slots, EliminationPlan& plan) {
  const Shape& shape = entries.shape;
  for (int i = 0; i < shape.node_sums; ++i) {
    plan.unit_entries.push_back(slots.blocks().equalities()(slots.row(i), next_size(shape) + shape.node + i));
  }
  for (int j = 0; j < shape.interval; ++j) {
    if (!entries.inner_is_fixed[static_cast<std::size_t>(j)]) continue;
    const int place = slots.column(shape.node + j);
    plan.unit_entries.push_back(slots.blocks().hessian()(place, place));
  }
}

void append_scatters(const IntervalEntries& entries, const Slots& slots, EliminationPlan& plan) {
  const Shape& shape = entries.shape;
  const ForwardBlocks<Shape> results{shape};
  for (int i = 0; i < shape.node; ++i) {
    const std::size_t first = entries.node_unknowns[static_cast<std::size_t>(i)];
    plan.scatters.push_back({results.next_state()(i, 0), false, first + 1});
  }
  for (int j = 0; j < shape.interval; ++j) {
    const auto column = static_cast<std::size_t>(j);
    if (entries.inner_is_fixed[column]) continue;
    const int place = slots.column(shape.node + j);
    const int index = place >= shape.rows ? results.columns()(place - shape.rows, 0) : results.dependent()(place, 0);
    plan.scatters.push_back({index, false, entries.inner_unknowns[column]});
  }
  for (int i = 0; i < shape.rows; ++i) {
    const bool of_node = i < shape.node_sums;
    const std::size_t first = of_node ? entries.node_rows[static_cast<std::size_t>(i)]
                                      : entries.interval_rows[static_cast<std::size_t>(i - shape.node_sums)];
    // Without rows of its own an interval's multipliers come as the derivative with respect to s, in natural order.
    plan.scatters.push_back({results.multipliers()(has_own_rows(shape) ? slots.row(i) : i, 0), true, first});
  }
}

}  // namespace

std::optional<EliminationPlan> elimination_plan(const IntervalEntries& entries, const NewtonArrays& arrays,
                                                std::size_t interval) {
  const Eigen::MatrixXd equalities = equalities_of(entries, arrays, interval);
  auto order = find_order(equalities, false);
  if (!order) return std::nullopt;
  const bool is_plain = determines_next_node(*order, entries.shape);
  if (is_plain) {
    // The same unknowns in their natural order, for which there are faster kernels.
    const auto natural = find_order(equalities, true);
    if (natural) order = natural;
  }
  const Slots slots(entries.shape, *order);
  EliminationPlan plan;
  plan.shape = entries.shape;
  plan.shape.is_plain = is_plain && std::is_sorted(order->columns.begin(), order->columns.end());
  for (const double pivot : order->pivots) plan.pivot_scales.push_back(1.0 / pivot);
  for (int i = 0; i < entries.shape.node; ++i) plan.node_in_next.push_back(slots.column(i));
  append_unit_entries(entries, slots, plan);
  append_gathers(entries, slots, plan);
  append_scatters(entries, slots, plan);
  return plan;
}

}  // namespace dmocbench::interior_point
