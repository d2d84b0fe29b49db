#pragma once

namespace dmocbench::kkt {

/// The sizes of one interval. Its KKT system couples the state X = (x_k, s_k, θ) with the next unknowns Z = (x_{k+1},
/// y_k). The equalities determine as many entries of Z, the dependent ones; the others are the free unknowns w
/// (README.md, "One interval").
struct Shape {
  int node;          ///< entries of x
  int node_sums;     ///< entries of s, which is also the number of rows of a node
  int global;        ///< entries of θ
  int interval;      ///< entries of y
  int rows;          ///< equalities of a node and of an interval together
  int inequalities;  ///< inequalities of an interval
  /// The dependent entries of Z are the unknowns of the next node, in their order.
  bool is_plain = false;
};

/// The same sizes as compile-time constants, for a plain shape.
template <int Node, int NodeSums, int Global, int Interval, int Rows>
struct FixedShape {
  static constexpr int node = Node;
  static constexpr int node_sums = NodeSums;
  static constexpr int global = Global;
  static constexpr int interval = Interval;
  static constexpr int rows = Rows;
  int inequalities;

  [[nodiscard]] static constexpr bool fits(const Shape& shape) {
    static_assert(Rows == Node, "the equalities of a plain shape determine the next node");
    return shape.is_plain && shape.node == Node && shape.node_sums == NodeSums && shape.global == Global &&
           shape.interval == Interval && shape.rows == Rows;
  }
};

/// X
constexpr int state_size(const auto& shape) { return shape.node + shape.node_sums + shape.global; }
/// Z
constexpr int next_size(const auto& shape) { return shape.node + shape.interval; }
/// w
constexpr int free_size(const auto& shape) { return next_size(shape) - shape.rows; }
/// Columns of everything that is linear in (w, X, 1).
constexpr int column_count(const auto& shape) { return free_size(shape) + state_size(shape) + 1; }

/// Columns of the equalities and of the Hessian of an interval: (Z, X, 1).
constexpr int local_column_count(const auto& shape) { return next_size(shape) + state_size(shape) + 1; }

/// The sizes under the names they have in the formulas.
struct Sizes {
  int n;  ///< equalities, and dependent entries of Z
  int Z;
  int X;
  int w;
  int N;  ///< columns (w, X, 1)
};
constexpr Sizes sizes_of(const auto& shape) {
  return {shape.rows, next_size(shape), state_size(shape), free_size(shape), column_count(shape)};
}

/// True if the dependent entries of Z are known to be the next node's unknowns, in their order. They are then part of
/// the next state, and their Hessian is added to the cost-to-go's before the transition is applied, so that the
/// transition is applied once.
template <class S>
inline constexpr bool is_always_plain = false;
template <int... sizes>
inline constexpr bool is_always_plain<FixedShape<sizes...>> = true;
constexpr bool is_plain(const Shape& shape) { return shape.is_plain; }
template <int... sizes>
constexpr bool is_plain(const FixedShape<sizes...>& /*shape*/) {
  return true;
}
/// True if entry i of x_{k+1} is dependent and node rows exist; `node_in_next` as in `EliminationPlan`. The equalities
/// then determine its increment x_{k+1,i} - x_{k,i}, and s_{k+1} is the sum with J_{k+1,k} x_k replaced by
/// -J_{k+1,k} (x_{k+1} - x_k), which for DMOC has the size of a momentum, unlike the plain sum (README.md).
template <class S>
constexpr bool moves_by_increment(const S& shape, const int* node_in_next, int i) {
  return shape.node_sums > 0 && (is_always_plain<S> || node_in_next[i] < shape.rows);
}
/// True if an interval has equalities of its own, whose multipliers the forward sweep computes.
constexpr bool has_own_rows(const auto& shape) { return shape.rows > shape.node_sums; }

/// A matrix within an array of numbers: where its entry (i, j) stands, column by column.
struct BlockPlace {
  int first;
  int rows;
  int columns;
  [[nodiscard]] constexpr int operator()(int i, int j) const { return first + i + j * rows; }
  [[nodiscard]] constexpr int end() const { return first + rows * columns; }
};

/// The places of the blocks of an interval's part of the KKT system in one array. Entries of Z come in the order of
/// elimination: dependent ones first.
template <class S>
struct LocalBlocks {
  S shape;
  /// rows x (Z, X, 1): derivatives of the equalities, and their values.
  [[nodiscard]] constexpr BlockPlace equalities() const { return {0, shape.rows, local_column_count(shape)}; }
  /// node_sums x (x, Z): the contributions to the rows of node k + 1.
  [[nodiscard]] constexpr BlockPlace carry() const {
    return {equalities().end(), shape.node_sums, shape.node + next_size(shape)};
  }
  /// Z x (Z, X, 1): Hessian and gradient.
  [[nodiscard]] constexpr BlockPlace hessian() const {
    return {carry().end(), next_size(shape), local_column_count(shape)};
  }
  /// inequalities x (Z, X, 1): derivatives of the inequalities, and their values.
  [[nodiscard]] constexpr BlockPlace inequalities() const {
    return {hessian().end(), shape.inequalities, local_column_count(shape)};
  }
  /// inequalities: e.
  [[nodiscard]] constexpr BlockPlace compliance() const { return {inequalities().end(), shape.inequalities, 1}; }
  [[nodiscard]] constexpr int size() const { return compliance().end(); }
};

/// The results of one step of the forward sweep, in one array.
template <class S>
struct ForwardBlocks {
  S shape;
  [[nodiscard]] constexpr BlockPlace columns() const { return {0, column_count(shape), 1}; }  ///< (w, X, 1)
  [[nodiscard]] constexpr BlockPlace next_state() const { return {columns().end(), state_size(shape), 1}; }
  [[nodiscard]] constexpr BlockPlace dependent() const { return {next_state().end(), shape.rows, 1}; }
  [[nodiscard]] constexpr BlockPlace multipliers() const { return {dependent().end(), shape.rows, 1}; }
  [[nodiscard]] constexpr int size() const { return multipliers().end(); }
};

/// The record of an interval that the backward sweep leaves for the forward sweep.
template <class S>
struct RecordBlocks {
  S shape;
  /// w x (X, 1, ν): w = -(gain)(X, 1, ν).
  [[nodiscard]] constexpr BlockPlace gain() const { return {0, free_size(shape), 2 * state_size(shape) + 1}; }
  /// (x, s) x (w, X, 1): the next state.
  [[nodiscard]] constexpr BlockPlace transition() const {
    return {gain().end(), shape.node + shape.node_sums, column_count(shape)};
  }
  /// rows x (w, X, 1): the dependent entries of Z, unless the transition has them.
  [[nodiscard]] constexpr BlockPlace dependent() const {
    return {transition().end(), is_plain(shape) ? 0 : shape.rows, column_count(shape)};
  }
  /// Where the interval has no rows of its own, node_sums x (X, 1, ν): the multipliers of the rows of node k. Else ...
  [[nodiscard]] constexpr BlockPlace multipliers() const {
    return {dependent().end(), shape.node_sums, 2 * state_size(shape) + 1};
  }
  /// ... rows x (w, X, 1, ν): the gradient that the multipliers of all its equalities balance, ...
  [[nodiscard]] constexpr BlockPlace gradient() const {
    return {dependent().end(), shape.rows, column_count(shape) + state_size(shape)};
  }
  /// ... and rows x rows: the factors of the equalities, with a last column of the reciprocals of the pivots.
  [[nodiscard]] constexpr BlockPlace factors() const { return {gradient().end(), shape.rows, shape.rows + 1}; }
  [[nodiscard]] constexpr int size() const { return has_own_rows(shape) ? factors().end() : multipliers().end(); }
};

}  // namespace dmocbench::kkt
