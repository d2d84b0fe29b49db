#include "methods/kkt/intervals/elimination_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace dmocbench::kkt {

namespace {

/// Rows and columns in the order of elimination: position -> natural number.
struct Order {
  Eigen::VectorXi rows;
  Eigen::VectorXi columns;  // of Z
  Eigen::VectorXd pivots;   // their magnitudes
};

/// Derivatives of the equalities of an interval with respect to Z.
Eigen::MatrixXd equality_jacobian(const IntervalEntries& entries, const NewtonArrays& arrays, Eigen::Index interval) {
  const Shape& shape = entries.shape;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(shape.rows, next_size(shape));
  for (const LocalEntry& entry : entries.local) {
    if (entry.block != LocalEntry::Block::equality || entry.column >= matrix.cols()) continue;
    matrix(entry.row, entry.column) = arrays.at(entry.source, entry.first + interval);
  }
  return matrix;
}

/// The order of rows and columns that complete pivoting chooses, for one or several matrices at once: a pivot is as
/// large as it can be in the matrix where it is smallest. None if a matrix is singular to rounding. With
/// `columns_in_order` only rows are exchanged: the columns keep their order, and the first ones become the dependent
/// unknowns. `Order::pivots` belong to the first matrix.
std::optional<Order> find_order(std::vector<Eigen::MatrixXd> matrices, bool columns_in_order) {
  const auto numbers = [](Eigen::Index count) {
    return Eigen::VectorXi::LinSpaced(count, 0, static_cast<int>(count) - 1);
  };
  const Eigen::Index rows = matrices.front().rows();
  const Eigen::Index columns = matrices.front().cols();
  Order order{numbers(rows), numbers(columns), Eigen::VectorXd(rows)};
  std::vector<Eigen::VectorXd> row_scales;
  for (const Eigen::MatrixXd& left : matrices) {
    if (!left.allFinite()) return std::nullopt;
    row_scales.emplace_back(left.cwiseAbs().rowwise().maxCoeff());
    if (rows > 0 && !(row_scales.back().minCoeff() > 0.0)) return std::nullopt;
  }
  constexpr double smallest = 1e-12;  // of a row's largest entry: below it a pivot is rounding
  for (Eigen::Index p = 0; p < rows; ++p) {
    // The largest remaining entry, with every row measured by its own largest entry.
    const Eigen::Index height = rows - p;
    const Eigen::Index width = columns_in_order ? 1 : columns - p;
    Eigen::ArrayXXd sizes = Eigen::ArrayXXd::Constant(height, width, std::numeric_limits<double>::infinity());
    for (std::size_t m = 0; m < matrices.size(); ++m) {
      sizes = sizes.min(matrices[m].block(p, p, height, width).array().abs().colwise() /
                        row_scales[m].tail(height).array());
    }
    Eigen::Index row = 0;
    Eigen::Index column = 0;
    if (!(sizes.maxCoeff(&row, &column) > smallest)) return std::nullopt;
    row += p;
    column += p;
    order.pivots[p] = std::abs(matrices.front()(row, column));
    std::swap(order.rows[p], order.rows[row]);
    std::swap(order.columns[p], order.columns[column]);
    for (std::size_t m = 0; m < matrices.size(); ++m) {
      Eigen::MatrixXd& left = matrices[m];
      left.row(p).swap(left.row(row));
      left.col(p).swap(left.col(column));
      std::swap(row_scales[m][p], row_scales[m][row]);
      for (Eigen::Index i = p + 1; i < rows; ++i) left.row(i) -= left(i, p) / left(p, p) * left.row(p);
    }
  }
  return order;
}

Eigen::VectorXi inverse(const Eigen::VectorXi& order) {
  Eigen::VectorXi places(order.size());
  for (int place = 0; const int number : order) places[number] = place++;
  return places;
}

/// Natural numbers of rows and columns to entries of `LocalBlocks`.
class Slots {
 public:
  Slots(const Shape& shape, const Order& order)
      : blocks_{shape}, row_at_(inverse(order.rows)), next_at_(inverse(order.columns)) {}

  [[nodiscard]] int column(int natural) const {
    return natural < next_size(blocks_.shape) ? next_at_[natural] : natural;
  }
  [[nodiscard]] int row(int natural) const { return row_at_[natural]; }
  [[nodiscard]] const LocalBlocks<Shape>& blocks() const { return blocks_; }

  /// The slot of an entry.
  [[nodiscard]] int of(const LocalEntry& entry) const {
    const int node = blocks_.shape.node;
    switch (entry.block) {
      case LocalEntry::Block::equality:
        return blocks_.equalities()(row(entry.row), column(entry.column));
      case LocalEntry::Block::carry:
        return blocks_.carry()(entry.row, entry.column < node ? entry.column : node + column(entry.column - node));
      case LocalEntry::Block::inequality:
        if (entry.column < 0) return blocks_.compliance()(entry.row, 0);
        return blocks_.inequalities()(entry.row, column(entry.column));
      case LocalEntry::Block::hessian:
        break;
    }
    return blocks_.hessian()(column(entry.row), column(entry.column));
  }
  /// The slot of its mirror image, where the blocks have that; else its own.
  [[nodiscard]] int mirror_of(const LocalEntry& entry) const {
    const bool has_mirror = entry.block == LocalEntry::Block::hessian && entry.column < next_size(blocks_.shape);
    return has_mirror ? blocks_.hessian()(column(entry.column), column(entry.row)) : of(entry);
  }

 private:
  LocalBlocks<Shape> blocks_;
  Eigen::VectorXi row_at_;
  Eigen::VectorXi next_at_;
};

void append_gathers(const IntervalEntries& entries, const Slots& slots, EliminationPlan& plan) {
  std::vector<bool> is_set(static_cast<std::size_t>(slots.blocks().size()), false);
  const auto append = [&](const LocalEntry& entry, bool from_before, int slot, int mirror) {
    const auto at = static_cast<std::size_t>(slot);
    plan.gathers.push_back({entry.source, is_set[at], from_before, entry.first, slot, mirror});
    is_set[at] = true;
  };
  for (const LocalEntry& entry : entries.local) append(entry, false, slots.of(entry), slots.mirror_of(entry));
  // The multiple of x_k that the interval before has added to s_k (`moves_by_increment`) is subtracted again.
  for (const LocalEntry& entry : entries.local) {
    if (entry.block != LocalEntry::Block::carry || entry.column >= entries.shape.node) continue;
    if (!moves_by_increment(entries.shape, plan.node_in_next.data(), entry.column)) continue;
    const int slot = slots.blocks().equalities()(slots.row(entry.row), next_size(entries.shape) + entry.column);
    append(entry, true, slot, slot);
  }
}

/// The entries that are 1 in every interval: s_k enters the equalities of its node with the factor 1, and the Hessian
/// of a fixed unknown is 1.
void append_unit_entries(const IntervalEntries& entries, const Slots& slots, EliminationPlan& plan) {
  const Shape& shape = entries.shape;
  for (int i = 0; i < shape.node_sums; ++i) {
    plan.unit_entries.push_back(slots.blocks().equalities()(slots.row(i), next_size(shape) + shape.node + i));
  }
  for (int column = shape.node; column < next_size(shape); ++column) {
    const int place = slots.column(column);
    if (entries.is_fixed_column(column)) plan.unit_entries.push_back(slots.blocks().hessian()(place, place));
  }
}

void append_scatters(const IntervalEntries& entries, const Slots& slots, EliminationPlan& plan) {
  const Shape& shape = entries.shape;
  const ForwardBlocks<Shape> results{shape};
  const auto index_of = [&](int column) {
    if (column < shape.node) return results.next_state()(column, 0);
    const int place = slots.column(column);
    return place >= shape.rows ? results.columns()(place - shape.rows, 0) : results.dependent()(place, 0);
  };
  for (int column = 0; column < next_size(shape); ++column) {
    if (!entries.is_fixed_column(column))
      plan.scatters.push_back({index_of(column), false, entries.unknown_in(column)});
  }
  for (int i = 0; const Eigen::Index first : entries.equality_rows) {
    // Where an interval has no equalities of its own, the kernel returns the multipliers of the node's equalities as
    // the derivative of the cost-to-go with respect to s, in the order of the program.
    plan.scatters.push_back({results.multipliers()(has_own_rows(shape) ? slots.row(i) : i, 0), true, first});
    ++i;
  }
}

}  // namespace

std::optional<EliminationPlan> elimination_plan(const IntervalEntries& entries, const NewtonArrays& arrays,
                                                const std::vector<Eigen::Index>& intervals) {
  std::vector<Eigen::MatrixXd> equalities;
  equalities.reserve(intervals.size());
  for (const Eigen::Index interval : intervals) equalities.push_back(equality_jacobian(entries, arrays, interval));
  auto order = find_order(equalities, false);
  if (!order) return std::nullopt;
  const Shape& shape = entries.shape;
  // The dependent unknowns are the next node's.
  const bool is_plain = shape.rows == shape.node && (order->columns.head(shape.rows).array() < shape.node).all();
  if (is_plain) {
    // The same unknowns in their natural order, for which there are faster kernels.
    const auto natural = find_order(equalities, true);
    if (natural) order = natural;
  }
  const Slots slots(shape, *order);
  EliminationPlan plan;
  plan.shape = shape;
  plan.shape.is_plain = is_plain && std::is_sorted(order->columns.begin(), order->columns.end());
  for (const double pivot : order->pivots) plan.pivot_scales.push_back(1.0 / pivot);
  for (int i = 0; i < shape.node; ++i) plan.node_in_next.push_back(slots.column(i));
  append_unit_entries(entries, slots, plan);
  append_gathers(entries, slots, plan);
  append_scatters(entries, slots, plan);
  return plan;
}

}  // namespace dmocbench::kkt
