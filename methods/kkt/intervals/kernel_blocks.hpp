#pragma once

#include "methods/kkt/intervals/segment_kernel.hpp"
#include "methods/kkt/intervals/shape.hpp"
#include "methods/runtime/lanes.hpp"

// A step is inlined into its sweep so that its blocks can live in registers; CMake changes this for sanitizers.
#ifndef DMOCBENCH_INLINE
#define DMOCBENCH_INLINE [[gnu::always_inline]] inline
#define DMOCBENCH_INLINED __attribute__((always_inline))  // for lambdas
#else
#define DMOCBENCH_INLINED
#endif

// NOLINTBEGIN(*-avoid-c-arrays,*-member-init,*-identifier-naming): in registers; names of the formulas
namespace dmocbench::kkt {
inline namespace DMOCBENCH_LANES {

inline Lanes smaller(const Lanes& a, const Lanes& b) { return chosen(a < b, a, b); }
inline Lanes larger(const Lanes& a, const Lanes& b) { return chosen(b < a, a, b); }
/// The smaller of both, or -1 where the second is NaN, so that the minimum so far keeps a trace of it.
inline Lanes least_so_far(const Lanes& so_far, const Lanes& value) {
  const Lanes::Mask is_number = value == value;  // NOLINT(misc-redundant-expression): not of NaN
  return smaller(so_far, chosen(is_number, value, Lanes::all(-1.0)));
}
inline Lanes magnitude(const Lanes& a) { return larger(a, -a); }

/// The amount that a pivot near zero adds to the number of negative ones: more than there are unknowns, so that it
/// cannot be taken for a number of pivots.
inline constexpr double uncertain = 1e15;

/// The signs of the pivots that were met so far: the pivots of the Hessians of free unknowns.
struct PivotSigns {
  Lanes hold = Lanes::all(1.0);  // 1, or -1 once one was not positive
  Lanes negative{};              // their number

  /// Takes note of a pivot, whose entry of the Hessian is `diagonal`. Returns the divisor: one in its place where it is
  /// rounding, so that it disturbs no other lane.
  DMOCBENCH_INLINE Lanes note(const Lanes& pivot, const Lanes& diagonal) {
    const Lanes one = Lanes::all(1.0);
    const Lanes size = magnitude(diagonal);
    const Lanes::Mask holds = Lanes::all(smallest_pivot_share) * size < pivot;
    const Lanes::Mask is_certain = Lanes::all(certain_pivot_share) * size < magnitude(pivot);
    hold = smaller(hold, chosen(holds, one, -one));
    negative += chosen(is_certain, chosen(pivot < Lanes{}, one, Lanes{}), Lanes::all(uncertain));
    return chosen(holds, pivot, chosen(is_certain, pivot, one));
  }
  /// Lanes that have no interval stay as they were.
  DMOCBENCH_INLINE void keep_where_inactive(const Lanes::Mask& active, const PivotSigns& before) {
    hold = chosen(active, hold, before.hold);
    negative = chosen(active, negative, before.negative);
  }
};

/// A matrix in an array, column by column.
template <class Number>
struct MatrixView {
  Number* first;
  int rows;
  DMOCBENCH_INLINE Number& operator()(int i, int j = 0) const { return first[i + j * rows]; }
};

DMOCBENCH_INLINE void copy(const Lanes* from, int count, Lanes* to) {
  for (int i = 0; i < count; ++i) to[i] = from[i];
}

template <class Number>
DMOCBENCH_INLINE MatrixView<Number> view(Number* array, const BlockPlace& place) {
  return {array + place.first, place.rows};
}

/// `from` may have more rows than `to`.
template <class Matrix>
DMOCBENCH_INLINE void copy_columns(const Matrix& from, int columns, const MatrixView<Lanes>& to) {
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < to.rows; ++i) to(i, j) = from(i, j);
  }
}

/// Hands out memory part by part; without memory it counts only.
struct Memory {
  Lanes* first;
  int taken = 0;

  Lanes* take(int count) {
    Lanes* const part = first == nullptr ? nullptr : first + taken;
    taken += count;
    return part;
  }
};

/// A matrix of lanes, column by column, whose sizes are functions of the shape. Where the shape is known at compile
/// time it is an array in place, which provably overlaps no other, so that the compiler can keep much of it in
/// registers.
template <class S, auto rows, auto columns, bool is_in_place = is_always_plain<S>>
class LaneMatrix {
 public:
  LaneMatrix(const S& shape, Memory& memory) : rows_(rows(shape)), first_(memory.take(rows_ * columns(shape))) {}
  [[nodiscard]] DMOCBENCH_INLINE int height() const { return rows_; }
  [[nodiscard]] DMOCBENCH_INLINE Lanes* data() { return first_; }
  DMOCBENCH_INLINE Lanes& operator()(int i, int j = 0) { return first_[i + j * rows_]; }
  DMOCBENCH_INLINE const Lanes& operator()(int i, int j = 0) const { return first_[i + j * rows_]; }

 private:
  int rows_;
  Lanes* first_;
};

template <class S, auto rows, auto columns>
class LaneMatrix<S, rows, columns, true> {
 public:
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): zeros would take time
  LaneMatrix(const S& /*shape*/, const Memory& /*memory*/) {}
  [[nodiscard]] static constexpr int height() { return rows(S{0}); }
  [[nodiscard]] DMOCBENCH_INLINE Lanes* data() { return numbers_; }
  DMOCBENCH_INLINE Lanes& operator()(int i, int j = 0) { return numbers_[i + j * height()]; }
  DMOCBENCH_INLINE const Lanes& operator()(int i, int j = 0) const { return numbers_[i + j * height()]; }

 private:
  static constexpr int count = rows(S{0}) * columns(S{0});
  Lanes numbers_[count > 0 ? count : 1];
};

// Sizes that only these blocks have.
inline constexpr auto row_count = [](const auto& shape) { return shape.rows; };
inline constexpr auto sum_count = [](const auto& shape) { return shape.node_sums; };
inline constexpr auto inequality_count = [](const auto& shape) { return shape.inequalities; };
inline constexpr auto value_columns = [](const auto& shape) { return 2 * state_size(shape) + 1; };
inline constexpr auto reachability_columns = [](const auto& shape) { return state_size(shape) + 1; };
inline constexpr auto scaled_columns = [](const auto& shape) { return column_count(shape) + state_size(shape); };
inline constexpr auto one_column = [](const auto& /*shape*/) { return 1; };

/// The number of lane numbers that `Work` takes from memory.
template <class Work, class S>
int size_of(const S& shape) {
  Memory none{nullptr};
  static_cast<void>(Work(shape, none));
  return none.taken;
}

/// The value of the segment as far as it is eliminated, as a function of its first state X and of the multiplier ν of
/// its last one (`SegmentGroup`).
template <class S>
struct CostToGo {
  CostToGo(const S& shape, Memory& memory) : value(shape, memory), reachability(shape, memory) {}

  DMOCBENCH_INLINE Lanes& P(int i, int j) { return value(i, j); }
  DMOCBENCH_INLINE Lanes& p(int i) { return value(i, value.height()); }
  DMOCBENCH_INLINE Lanes& Phi(int i, int j) { return value(i, value.height() + 1 + j); }
  DMOCBENCH_INLINE Lanes& gamma(int i) { return reachability(i, 0); }
  DMOCBENCH_INLINE Lanes& Gamma(int i, int j) { return reachability(i, 1 + j); }

  LaneMatrix<S, state_size<S>, value_columns> value;                // X x (X, 1, ν): P, p, Φ
  LaneMatrix<S, state_size<S>, reachability_columns> reachability;  // ν x (1, ν): γ, lower triangle of Γ
  PivotSigns signs;
  Lanes smallest_ratio;  // of the pivots of the equalities
};

/// One step of all lanes: the blocks of its intervals, and the order in which they are eliminated.
template <class S>
struct LocalSystem {
  LocalSystem(const S& the_shape, const EliminationPlan& plan, const Lanes* numbers)
      : shape(the_shape),
        node_in_next(plan.node_in_next.data()),
        pivot_scales(plan.pivot_scales.data()),
        equality(view(numbers, LocalBlocks<S>{shape}.equalities())),
        carry(view(numbers, LocalBlocks<S>{shape}.carry())),
        hessian(view(numbers, LocalBlocks<S>{shape}.hessian())),
        inequality(view(numbers, LocalBlocks<S>{shape}.inequalities())),
        compliance(view(numbers, LocalBlocks<S>{shape}.compliance())) {}

  [[nodiscard]] DMOCBENCH_INLINE bool moves_by_increment(int i) const {
    return kkt::moves_by_increment(shape, node_in_next, i);
  }
  /// The entry of Z that is entry i of x_{k+1}.
  [[nodiscard]] DMOCBENCH_INLINE int next_of_node(int i) const { return is_always_plain<S> ? i : node_in_next[i]; }

  S shape;
  const int* node_in_next;
  const double* pivot_scales;
  MatrixView<const Lanes> equality;    // rows x (Z, X, 1)
  MatrixView<const Lanes> carry;       // node_sums x (x, Z)
  MatrixView<const Lanes> hessian;     // Z x (Z, X, 1)
  MatrixView<const Lanes> inequality;  // inequalities x (Z, X, 1)
  MatrixView<const Lanes> compliance;
};

}  // namespace DMOCBENCH_LANES
}  // namespace dmocbench::kkt
// NOLINTEND(*-avoid-c-arrays,*-member-init,*-identifier-naming)
