#pragma once

#include "methods/kkt/intervals/fixed_size_step.hpp"
#include "methods/kkt/intervals/kernel_blocks.hpp"
#include "methods/kkt/intervals/products.hpp"

// One step of both sweeps for sizes that are unknown at compile time. The formulas are the same as in
// fixed_size_step.hpp and README.md, as products of matrices (products.hpp) instead of loops.
// NOLINTBEGIN(*-avoid-c-arrays): arrays that live in registers
namespace dmocbench::kkt {
inline namespace DMOCBENCH_LANES {

/// Work of one step backward.
template <>
struct StepWork<Shape> {
  using S = Shape;
  StepWork(const Shape& shape, Memory& memory)
      : equalities(shape, memory),
        reciprocals(shape, memory),
        next(shape, memory),
        of_dependent(shape, memory),
        gradient(shape, memory),
        whole_transition(shape, memory),
        costate(shape, memory),
        lines(shape, memory),
        condensed(shape, memory),
        scaled(shape, memory),
        last_state(shape, memory),
        reachability(shape, memory) {}

  /// The dependent entries of Z as functions of (w, X, 1).
  [[nodiscard]] Block dependent(const Shape& shape) { return shape.is_plain ? transition : block(next); }

  LaneMatrix<S, row_count, local_column_count<S>> equalities;      // n x (Z, X, 1): factors; then dependent Z, negative
  LaneMatrix<S, row_count, one_column> reciprocals;                // of the pivots
  LaneMatrix<S, next_size<S>, column_count<S>> next;               // Z as a function of (w, X, 1), unless it is plain
  LaneMatrix<S, sum_count, row_count> of_dependent;                // the next s as a function of the dependent Z
  LaneMatrix<S, next_size<S>, column_count<S>> gradient;           // of the interval's own cost with respect to Z
  Block transition{nullptr, 1, 0};                                 // the next state as a function of (w, X, 1)
  LaneMatrix<S, state_size<S>, column_count<S>> whole_transition;  // its place if the record lacks rows of it
  LaneMatrix<S, state_size<S>, column_count<S>> costate;           // derivative of the next state's cost, of (w, X, 1)
  LaneMatrix<S, inequality_count, column_count<S>> lines;          // the inequalities, weighted by 1/e
  LaneMatrix<S, column_count<S>, column_count<S>>
      condensed;                                       // quadratic form of interval and cost-to-go; lower triangle
  LaneMatrix<S, free_size<S>, scaled_columns> scaled;  // w x (w, X, 1, ν): eliminated rows divided by pivots
  LaneMatrix<S, column_count<S>, state_size<S>> last_state;  // (w, X, 1) x ν
  LaneMatrix<S, state_size<S>, state_size<S>> reachability;  // ν x ν: the next Γ, lower triangle
};

/// Rows and columns that are eliminated one by one, between products that eliminate all before them at once.
inline constexpr int block_size = 4;

/// Calls `eliminate(begin, end)` for consecutive blocks of `size` rows, the last ones first.
template <class Eliminate>
inline void for_blocks_from_the_last(int size, const Eliminate& eliminate) {
  for (int begin = (size - 1) / block_size * block_size; begin >= 0; begin -= block_size) {
    eliminate(begin, begin + block_size < size ? begin + block_size : size);
  }
}

/// Solves U x = b for every column of `right`, in place; U is `size` x `size`. Unit diagonal if `reciprocals` is null,
/// else `reciprocals` holds its inverse.
inline void solve_upper(const ConstBlock& U, const Lanes* reciprocals, int size, int columns, const Block& right) {
  for_blocks_from_the_last(size, [&](int begin, int end) {
    subtract_product(right.from(begin, 0), U.from(begin, end), right.from(end, 0), {end - begin, columns, size - end});
    for (int j = 0; j < columns; ++j) {
      for (int p = end - 1; p >= begin; --p) {
        Lanes sum = right(p, j);
        for (int q = p + 1; q < end; ++q) sum -= U(p, q) * right(q, j);
        right(p, j) = reciprocals == nullptr ? sum : sum * reciprocals[p];
      }
    }
  });
}

/// Factors of the first `rows` columns of E, L U with the unit diagonal in L, in place; the others become L⁻¹ E.
inline void factorise_equalities(const LocalSystem<Shape>& local, CostToGo<Shape>& V, StepWork<Shape>& work) {
  const int n = local.shape.rows;
  const int columns = local_column_count(local.shape);
  const Block E = block(work.equalities);
  for (int begin = 0; begin < n; begin += block_size) {
    const int end = begin + block_size < n ? begin + block_size : n;
    subtract_product(E.from(begin, begin), E.from(begin, 0), E.from(0, begin), {end - begin, columns - begin, begin});
    subtract_product(E.from(end, begin), E.from(end, 0), E.from(0, begin), {n - end, end - begin, begin});
    for (int p = begin; p < end; ++p) {
      const Lanes pivot = E(p, p);
      V.smallest_ratio = least_so_far(V.smallest_ratio, magnitude(pivot) * Lanes::all(local.pivot_scales[p]));
      work.reciprocals(p) = Lanes::all(1.0) / pivot;
      for (int i = p + 1; i < n; ++i) E(i, p) = E(i, p) * work.reciprocals(p);
      for (int j = p + 1; j < end; ++j) {
        for (int i = p + 1; i < n; ++i) E(i, j) -= E(i, p) * E(p, j);
      }
    }
    for (int j = end; j < columns; ++j) {
      for (int p = begin; p < end; ++p) {
        for (int i = p + 1; i < end; ++i) E(i, j) -= E(i, p) * E(p, j);
      }
    }
  }
}

/// Solves the equalities for the dependent entries of Z. Rows and columns come in an order in which no exchange is
/// needed, see elimination_plan.hpp.
inline void eliminate_equalities(const LocalSystem<Shape>& local, CostToGo<Shape>& V, StepWork<Shape>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  copy(local.equality.first, n * (Z + X + 1), work.equalities.data());
  for (int i = 0; i < local.shape.node; ++i) {
    if (!local.moves_by_increment(i)) continue;
    for (int row = 0; row < n; ++row) work.equalities(row, Z + i) += work.equalities(row, local.next_of_node(i));
  }
  factorise_equalities(local, V, work);
  const Block E = block(work.equalities);
  solve_upper(E, work.reciprocals.data(), n, N, E.from(0, n));
}

/// The contributions to the rows of the next node. The dependent entries in the work are still increments.
inline void sum_at_next_node(const LocalSystem<Shape>& local, StepWork<Shape>& work) {
  const Shape& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  if (shape.node_sums == 0) return;
  const Block sums = work.transition.from(shape.node, 0);
  for (int j = 0; j < N; ++j) {
    for (int row = 0; row < shape.node_sums; ++row) {
      sums(row, j) = j < w ? local.carry(row, shape.node + n + j) : Lanes{};
    }
  }
  for (int z = 0; z < n; ++z) {
    for (int row = 0; row < shape.node_sums; ++row) work.of_dependent(row, z) = local.carry(row, shape.node + z);
  }
  for (int i = 0; i < shape.node; ++i) {
    for (int row = 0; row < shape.node_sums; ++row) {
      if (local.moves_by_increment(i)) {
        work.of_dependent(row, local.next_of_node(i)) -= local.carry(row, i);
      } else {
        sums(row, w + i) = local.carry(row, i);
      }
    }
  }
  add_product(sums, block(work.of_dependent), work.dependent(shape), {shape.node_sums, N, n});
}

/// Z and the next state as linear functions of (w, X, 1). The next state is made in the record where it stands there as
/// it is.
inline void make_transition(const LocalSystem<Shape>& local, StepWork<Shape>& work, Lanes* record) {
  const Shape& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  const MatrixView<Lanes> recorded = view(record, RecordBlocks<Shape>{shape}.transition());
  work.transition = shape.global == 0 ? block(recorded) : block(work.whole_transition);
  const Lanes zero{};
  const Lanes one = Lanes::all(1.0);
  const Block dependent = work.dependent(shape);
  for (int j = 0; j < N; ++j) {
    for (int i = 0; i < n; ++i) dependent(i, j) = -work.equalities(i, n + j);
  }
  sum_at_next_node(local, work);
  for (int i = 0; i < shape.node; ++i) {
    if (local.moves_by_increment(i)) dependent(local.next_of_node(i), w + i) += one;
  }
  for (int j = 0; j < N; ++j) {
    if (!shape.is_plain) {
      for (int i = 0; i < w; ++i) work.next(n + i, j) = i == j ? one : zero;
      for (int i = 0; i < shape.node; ++i) work.transition(i, j) = work.next(local.node_in_next[i], j);
    }
    for (int i = shape.node + shape.node_sums; i < X; ++i) work.transition(i, j) = j == w + i ? one : zero;
  }
}

/// Derivatives of the interval's cost with respect to Z, and of the cost-to-go with respect to the next state, as
/// functions of (w, X, 1). If the shape is plain, the dependent entries of Z are part of the next state, and their
/// derivatives of that state: the Hessian of the interval is added to the Hessian of the cost-to-go, which `advance`
/// replaces, in the active lanes only.
inline void differentiate_interval(const LocalSystem<Shape>& local, const Lanes::Mask* active, CostToGo<Shape>& V,
                                   StepWork<Shape>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  const ConstBlock H = block(local.hessian);
  const int of_state = local.shape.is_plain ? n : 0;
  for (int j = 0; j < of_state; ++j) {
    for (int i = 0; i < of_state; ++i) V.P(i, j) += active == nullptr ? H(i, j) : chosen(*active, H(i, j), Lanes{});
  }
  set_product(block(work.costate), block(V.value), work.transition, {X, N, X});
  for (int i = 0; i < X; ++i) work.costate(i, N - 1) += V.p(i);
  for (int j = 0; j < N; ++j) {
    const int column = j < w ? n + j : Z + j - w;
    for (int i = 0; i < of_state; ++i) work.costate(i, j) += H(i, column);
    for (int i = of_state; i < Z; ++i) work.gradient(i, j) = H(i, column);
  }
  add_product(block(work.gradient).from(of_state, 0), H.from(of_state, 0), work.dependent(local.shape),
              {Z - of_state, N, n});
}

/// An inequality whose slack is eliminated adds its square, weighted by 1/e, to the quadratic form. This adds the
/// derivative of the squares with respect to Z, and makes the inequalities functions of (w, X, 1), weighted by 1/e.
inline void add_inequalities(const LocalSystem<Shape>& local, StepWork<Shape>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  const int rows = local.shape.inequalities;
  const ConstBlock C = block(local.inequality);
  const Block lines = block(work.lines);
  for (int j = 0; j < N; ++j) {
    for (int row = 0; row < rows; ++row) lines(row, j) = C(row, j < w ? n + j : Z + j - w);
  }
  add_product(lines, C, work.dependent(local.shape), {rows, N, n});
  for (int row = 0; row < rows; ++row) {
    const Lanes weight = Lanes::all(1.0) / local.compliance(row);
    for (int j = 0; j < N; ++j) lines(row, j) = weight * lines(row, j);
  }
  const int of_state = local.shape.is_plain ? n : 0;
  add_product(block(work.costate), C.transposed(), lines, {of_state, N, rows});
  add_product(block(work.gradient).from(of_state, 0), C.from(0, of_state).transposed(), lines, {Z - of_state, N, rows});
}

/// The quadratic form of the interval and of the cost-to-go, in (w, X, 1).
inline void condense(const LocalSystem<Shape>& local, const Lanes::Mask* active, CostToGo<Shape>& V,
                     StepWork<Shape>& work) {
  const Shape& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  differentiate_interval(local, active, V, work);
  if (shape.inequalities > 0) add_inequalities(local, work);
  const Block form = block(work.condensed);
  const Block dependent = work.dependent(shape);
  clear_above_diagonal(form, N);
  set_product(form, block(work.costate).transposed(), work.transition, {N, w + X, X, Part::lower});
  if (!shape.is_plain) add_product(form, block(work.gradient).transposed(), dependent, {N, w + X, n, Part::lower});
  for (int j = 0; j < w; ++j) {
    for (int i = j; i < N; ++i) form(i, j) += work.gradient(n + j, i);
  }
  const Block of_state = form.from(w, w);
  add_product(of_state, dependent.from(0, w).transposed(), block(local.hessian).from(0, Z), {N - w, X, n, Part::lower});
  add_product(of_state, block(work.lines).from(0, w).transposed(), block(local.inequality).from(0, Z),
              {N - w, X, shape.inequalities, Part::lower});
  set_product(block(work.last_state), work.transition.transposed(), block(V.value).from(0, X + 1), {N, X, X});
}

/// Eliminates one free unknown from the rows of its block: `factorise_free`. `diagonal` is its entry of the Hessian.
inline void eliminate_free(const Shape& shape, int p, const Lanes& diagonal, CostToGo<Shape>& V,
                           StepWork<Shape>& work) {
  const int X = state_size(shape);
  const int N = column_count(shape);
  const Lanes reciprocal = Lanes::all(1.0) / V.signs.note(work.condensed(p, p), diagonal);
  for (int i = p + 1; i < N; ++i) work.scaled(p, i) = work.condensed(i, p) * reciprocal;
  for (int j = 0; j < X; ++j) work.scaled(p, N + j) = work.last_state(p, j) * reciprocal;
}

/// Factors L D Lᵀ of the free unknowns' Hessian: the eliminated rows stay in `condensed` and `last_state`, the same
/// divided by the pivots goes to `scaled`.
inline void factorise_free(const Shape& shape, CostToGo<Shape>& V, StepWork<Shape>& work) {
  const auto [n, Z, X, w, N] = sizes_of(shape);
  const Block C = block(work.condensed);
  const Block nu = block(work.last_state);
  const Block scaled = block(work.scaled);
  for (int begin = 0; begin < w; begin += block_size) {
    const int end = begin + block_size < w ? begin + block_size : w;
    Lanes diagonal[block_size];
    for (int p = begin; p < end; ++p) diagonal[p - begin] = C(p, p);
    subtract_product(C.from(begin, begin), C.from(begin, 0), scaled.from(0, begin), {N - begin, end - begin, begin});
    subtract_product(nu.from(begin, 0), scaled.from(0, begin).transposed(), nu, {end - begin, X, begin});
    for (int p = begin; p < end; ++p) {
      for (int q = begin; q < p; ++q) {
        for (int i = p; i < N; ++i) C(i, p) -= C(i, q) * scaled(q, p);
        for (int j = 0; j < X; ++j) nu(p, j) -= scaled(q, p) * nu(q, j);
      }
      eliminate_free(shape, p, diagonal[p - begin], V, work);
    }
  }
}

/// The cost-to-go with this interval in front, of the active lanes.
inline void advance(const Shape& shape, const Lanes::Mask* active, StepWork<Shape>& work, CostToGo<Shape>& V) {
  const auto [n, Z, X, w, N] = sizes_of(shape);
  const ConstBlock eliminated = block(work.condensed).from(w, 0);
  const ConstBlock scaled_nu = block(work.scaled).from(0, N);
  const Block value = block(work.condensed).from(w, w);
  const Block of_nu = block(work.last_state).from(w, 0);
  const bool has_all_lanes = active == nullptr;
  if (!has_all_lanes) copy(&V.Gamma(0, 0), X * X, work.reachability.data());
  const Block reachability = has_all_lanes ? Block{&V.Gamma(0, 0), 1, X} : block(work.reachability);
  subtract_product(value, eliminated, block(work.scaled).from(0, w), {X + 1, X, w, Part::lower});
  subtract_product(of_nu, eliminated, scaled_nu, {X + 1, X, w});
  add_product(reachability, block(work.last_state).transposed(), scaled_nu, {X, X, w, Part::lower});
  const auto put = [&](Lanes& target, const Lanes& number) {
    target = has_all_lanes ? number : chosen(*active, number, target);
  };
  for (int j = 0; j < X; ++j) {
    for (int i = j; i < X; ++i) {
      put(V.P(i, j), value(i, j));
      put(V.P(j, i), value(i, j));
      if (!has_all_lanes) put(V.Gamma(i, j), reachability(i, j));
    }
    for (int i = 0; i < X; ++i) put(V.Phi(i, j), of_nu(i, j));
    put(V.p(j), value(X, j));
    put(V.gamma(j), V.gamma(j) + of_nu(X, j));
  }
}

/// w = -(gain)(X, 1, ν): L⁻ᵀ applied to the result of `factorise_free`.
inline void store_gain(const Shape& shape, StepWork<Shape>& work, const MatrixView<Lanes>& gain) {
  const int w = free_size(shape);
  const int columns = 2 * state_size(shape) + 1;
  copy(&work.scaled(0, w), w * columns, gain.first);
  solve_upper(block(work.scaled), nullptr, w, columns, block(gain));
}

inline void store_transition(const Shape& shape, const StepWork<Shape>& work, Lanes* record) {
  const RecordBlocks<Shape> places{shape};
  const int columns = column_count(shape);
  if (shape.global > 0) copy_columns(work.transition, columns, view(record, places.transition()));
  if (!shape.is_plain) copy_columns(work.next, columns, view(record, places.dependent()));
}

/// The gradient that the multipliers of the interval's equalities balance; before `advance`.
inline void store_gradient(const LocalSystem<Shape>& local, CostToGo<Shape>& V, StepWork<Shape>& work,
                           const MatrixView<Lanes>& gradient) {
  const Shape& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  for (int j = 0; j < N + X; ++j) {
    const Lanes* const of_next = j < N ? &work.costate(0, j) : &V.Phi(0, j - N);
    for (int z = 0; z < n; ++z) gradient(z, j) = j < N && !shape.is_plain ? work.gradient(z, j) : Lanes{};
    for (int i = 0; i < shape.node; ++i) {
      const int z = local.next_of_node(i);
      if (z < n) gradient(z, j) += of_next[i];
    }
  }
  const ConstBlock of_sums = block(work.of_dependent).transposed();
  add_product(block(gradient), of_sums, block(work.costate).from(shape.node, 0), {n, N, shape.node_sums});
  add_product(block(gradient).from(0, N), of_sums, block(V.value).from(shape.node, X + 1), {n, X, shape.node_sums});
}

/// One step: free unknowns, next state, dependent unknowns and multipliers from the state and ν.
inline void step_forward(const Shape& shape, const Lanes* record, const Lanes* nu, Lanes* work) {
  const RecordBlocks<Shape> places{shape};
  const ForwardBlocks<Shape> results{shape};
  const auto [n, Z, X, w, N] = sizes_of(shape);
  Lanes* const columns = work + results.columns().first;
  const Lanes* const state = columns + w;  // (X, 1)
  Lanes* const next_state = work + results.next_state().first;
  Lanes* const multipliers = work + results.multipliers().first;
  const auto apply = [&](const BlockPlace& place, const Lanes* to, int size, Lanes* result) {
    set_product(column(result), block(view(record, place)), column(to), {place.rows, 1, size});
  };
  const auto add_applied = [&](const BlockPlace& place, int from, Lanes* result) {  // to ν
    add_product(column(result), block(view(record, place)).from(0, from), column(nu), {place.rows, 1, X});
  };
  apply(places.gain(), state, X + 1, columns);
  add_applied(places.gain(), X + 1, columns);
  for (int i = 0; i < w; ++i) columns[i] = -columns[i];
  apply(places.transition(), columns, N, next_state);
  for (int i = shape.node + shape.node_sums; i < X; ++i) next_state[i] = state[i];
  apply(places.dependent(), columns, N, work + results.dependent().first);
  if (has_own_rows(shape)) {
    apply(places.gradient(), columns, N, multipliers);
    add_applied(places.gradient(), N, multipliers);
    for (int i = 0; i < n; ++i) multipliers[i] = -multipliers[i];
    solve_transposed(shape, view(record, places.factors()), multipliers);
  } else {
    apply(places.multipliers(), state, X + 1, multipliers);
    add_applied(places.multipliers(), X + 1, multipliers);
  }
}

}  // namespace DMOCBENCH_LANES
}  // namespace dmocbench::kkt
// NOLINTEND(*-avoid-c-arrays)
