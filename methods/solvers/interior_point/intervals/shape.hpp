#pragma once

namespace dmocbench::interior_point {

/// Sizes of what one interval of a program works with. The KKT system of interval k couples
///
///   - the state X = (x_k, s_k, θ): the unknowns x_k of node k, the sum s_k that the rows of node k receive from
///     interval k - 1 (shifted by a multiple of x_k, see `moves_by_increment`), and unknowns θ of the whole horizon;
///   - the next unknowns Z = (x_{k+1}, y_k), with y_k the unknowns of the interval itself;
///   - its equalities: those of node k, then its own. They determine as many entries of Z, the dependent ones; the
///     others are the free unknowns w of the interval.
///
/// DMOC carries x = q and, in s, what becomes its momentum; both kinds of collocation carry (q, p) or (q, v) in x, and
/// nothing in s.
struct Shape {
  int node;          ///< entries of x
  int carried;       ///< entries of s, which is also the number of rows of a node
  int shared;        ///< entries of θ
  int inner;         ///< entries of y
  int rows;          ///< equalities: those of a node and those of an interval
  int inequalities;  ///< inequalities of an interval
  /// The dependent entries of Z are the unknowns of the next node, in their order.
  bool is_plain = false;
};

/// The same sizes as constants of the compiler, of a shape that is plain.
template <int Node, int Carried, int Shared, int Inner, int Rows>
struct FixedShape {
  static constexpr int node = Node;
  static constexpr int carried = Carried;
  static constexpr int shared = Shared;
  static constexpr int inner = Inner;
  static constexpr int rows = Rows;
  int inequalities;

  [[nodiscard]] static constexpr bool fits(const Shape& shape) {
    static_assert(Rows == Node, "the equalities of a plain shape determine the next node");
    return shape.is_plain && shape.node == Node && shape.carried == Carried && shape.shared == Shared &&
           shape.inner == Inner && shape.rows == Rows;
  }
};

template <class S>
constexpr int state_size(const S& shape) {
  return shape.node + shape.carried + shape.shared;
}
template <class S>
constexpr int next_size(const S& shape) {
  return shape.node + shape.inner;
}
template <class S>
constexpr int free_size(const S& shape) {
  return next_size(shape) - shape.rows;
}
/// True where the dependent entries of Z are known to be the next node's unknowns, in their order: they stand in the
/// next state, and their Hessian joins that of the rest before the transition is applied, instead of being applied
/// twice.
template <class S>
inline constexpr bool is_always_plain = false;
template <int node, int carried, int shared, int inner, int rows>
inline constexpr bool is_always_plain<FixedShape<node, carried, shared, inner, rows>> = true;
/// True if entry i of x_{k+1} is dependent and node rows exist; `node_in_next` as in `EliminationPlan`. The equalities
/// then determine its increment x_{k+1,i} - x_{k,i}, and s_{k+1} is the sum with J_{k+1,k} x_k replaced by
/// -J_{k+1,k} (x_{k+1} - x_k). For DMOC both stay of the size of a momentum, where x_k and J_{k+1,k} x_k, about M/h
/// x_k, would have to cancel in every interval, and cost a digit whenever the intervals become three times shorter.
template <class S>
constexpr bool moves_by_increment(const S& shape, const int* node_in_next, int i) {
  return shape.carried > 0 && (is_always_plain<S> || node_in_next[i] < shape.rows);
}
/// Columns of everything that is linear in (w, X, 1).
template <class S>
constexpr int column_count(const S& shape) {
  return free_size(shape) + state_size(shape) + 1;
}
/// True if an interval has equalities of its own, whose multipliers the forward sweep computes.
template <class S>
constexpr bool has_own_rows(const S& shape) {
  return shape.rows > shape.carried;
}

/// Where the blocks of an interval's part of the KKT system stand in one array, column by column. Entries of Z come in
/// the order of elimination: dependent ones first.
template <class S>
struct LocalBlocks {
  S shape;
  /// rows x (Z, X, 1): derivatives of the equalities, and their values.
  [[nodiscard]] constexpr int equalities() const { return 0; }
  [[nodiscard]] constexpr int equality(int row, int column) const { return equalities() + row + column * shape.rows; }
  /// carried x (x, Z): what the rows of node k + 1 receive.
  [[nodiscard]] constexpr int carry() const {
    return equalities() + shape.rows * (next_size(shape) + state_size(shape) + 1);
  }
  [[nodiscard]] constexpr int carry(int row, int column) const { return carry() + row + column * shape.carried; }
  /// Z x (Z, X, 1): Hessian and slope.
  [[nodiscard]] constexpr int hessian() const { return carry() + shape.carried * (shape.node + next_size(shape)); }
  [[nodiscard]] constexpr int hessian(int row, int column) const { return hessian() + row + column * next_size(shape); }
  /// inequalities x (Z, X, 1): derivatives of the inequalities, and their values.
  [[nodiscard]] constexpr int inequality() const {
    return hessian() + next_size(shape) * (next_size(shape) + state_size(shape) + 1);
  }
  [[nodiscard]] constexpr int inequality(int row, int column) const {
    return inequality() + row + column * shape.inequalities;
  }
  /// inequalities: e.
  [[nodiscard]] constexpr int compliance() const {
    return inequality() + shape.inequalities * (next_size(shape) + state_size(shape) + 1);
  }
  [[nodiscard]] constexpr int size() const { return compliance() + shape.inequalities; }
};

/// What the backward sweep leaves for the forward sweep, per interval.
template <class S>
struct RecordBlocks {
  S shape;
  /// free x (X, 1, ν): w = -(gain)(X, 1, ν).
  [[nodiscard]] constexpr int gain() const { return 0; }
  /// (x, s) x (w, X, 1): the next state.
  [[nodiscard]] constexpr int transition() const { return gain() + free_size(shape) * (2 * state_size(shape) + 1); }
  /// rows x (w, X, 1): the dependent entries of Z, unless the transition has them.
  [[nodiscard]] constexpr int dependent() const {
    return transition() + (shape.node + shape.carried) * column_count(shape);
  }
  [[nodiscard]] constexpr int dependent_rows() const { return is_always_plain<S> ? 0 : shape.rows; }
  /// carried x (X, 1, ν): the multipliers of the rows of node k, where the interval has no rows of its own ...
  [[nodiscard]] constexpr int multipliers() const { return dependent() + dependent_rows() * column_count(shape); }
  /// ... or rows x (w, X, 1) and rows x ν: the slope that they balance, ...
  [[nodiscard]] constexpr int slope() const { return multipliers(); }
  /// ... and the factors of the equalities: rows x rows, then the reciprocals of the pivots.
  [[nodiscard]] constexpr int factors() const {
    return slope() + shape.rows * (column_count(shape) + state_size(shape));
  }
  [[nodiscard]] constexpr int size() const {
    return has_own_rows(shape) ? factors() + shape.rows * (shape.rows + 1)
                               : multipliers() + shape.carried * (2 * state_size(shape) + 1);
  }
};

}  // namespace dmocbench::interior_point
