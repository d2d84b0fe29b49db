// Included by segment_kernel.cpp alone, see lanes.hpp.

/// Numbers of lanes that the work of one step backward takes.
template <class S>
struct StepSizes {
  S shape;
  [[nodiscard]] constexpr int equalities() const { return shape.rows * (next_size(shape) + state_size(shape) + 1); }
  [[nodiscard]] constexpr int next() const { return next_size(shape) * column_count(shape); }
  [[nodiscard]] constexpr int transition() const { return state_size(shape) * column_count(shape); }
  [[nodiscard]] constexpr int condensed() const { return column_count(shape) * column_count(shape); }
  [[nodiscard]] constexpr int scaled() const { return free_size(shape) * (column_count(shape) + state_size(shape)); }
  [[nodiscard]] constexpr int value() const { return state_size(shape) * (2 * state_size(shape) + 1); }
  [[nodiscard]] constexpr int reach() const { return state_size(shape) * (state_size(shape) + 1); }
  [[nodiscard]] constexpr int all() const {
    return equalities() + shape.rows + 2 * next() + 3 * transition() + condensed() + scaled() + column_count(shape) +
           value() + reach() + 2;
  }
};

/// Work of one step backward. All blocks are column by column. Where the shape is known to the compiler the blocks are
/// arrays in place, of which it knows that no two overlap, so that it can keep much of them in registers.
template <class S>
struct StepWork {
  StepWork(const S& s, Lanes* memory) : shape(s) {
    const StepSizes<S> sizes{s};
    const auto take = [&](int count) {
      Lanes* begin = memory;
      memory += count;
      return begin;
    };
    equalities = take(sizes.equalities());
    reciprocals = take(s.rows);
    next = take(sizes.next());
    slope = take(sizes.next());
    transition = take(sizes.transition());
    weighted = take(sizes.transition());
    condensed = take(sizes.condensed());
    scaled = take(sizes.scaled());
    line = take(column_count(s));
    reached = take(sizes.transition());
    value = take(sizes.value());
    reach = take(sizes.reach());
    pivots_hold = take(1);
    smallest_ratio = take(1);
  }

  S shape;
  Lanes* equalities;   // rows x (Z, X, 1): factorised; then dependent entries of Z, negative
  Lanes* reciprocals;  // rows: of the pivots
  Lanes* next;         // Z x (w, X, 1): Z as a function of the free unknowns and the state
  Lanes* slope;        // Z x (w, X, 1): derivative of the interval's own cost with respect to Z
  Lanes* transition;   // X x (w, X, 1): the next state
  Lanes* weighted;     // X x (w, X, 1): derivative of the value of the rest with respect to the next state
  Lanes* condensed;    // (w, X, 1) x (w, X, 1): the quadratic form of interval and rest; lower triangle
  Lanes* scaled;       // w x (w, X, 1, ν): rows that are eliminated, divided by their pivots
  Lanes* line;         // (w, X, 1): an inequality, weighted
  Lanes* reached;      // (w, X, 1) x ν
  Lanes* value;        // X x (X, 1, ν): P, p, Φ
  Lanes* reach;        // ν x (1, ν): γ, lower triangle of Γ
  Lanes* pivots_hold;  // 1, or -1 once one did not
  Lanes* smallest_ratio;
};

template <int... numbers>
struct StepWork<FixedShape<numbers...>> {
  using S = FixedShape<numbers...>;
  static constexpr StepSizes<S> sizes{S{0}};
  static constexpr int at_least_one(int count) { return count > 0 ? count : 1; }

  StepWork(const S& s, Lanes* /*memory*/) : shape(s) {}

  S shape;
  Lanes equalities[at_least_one(sizes.equalities())];
  Lanes reciprocals[at_least_one(S::rows)];
  Lanes next[sizes.next()];
  Lanes slope[sizes.next()];
  Lanes transition[sizes.transition()];
  Lanes weighted[sizes.transition()];
  Lanes condensed[sizes.condensed()];
  Lanes scaled[at_least_one(sizes.scaled())];
  Lanes line[column_count(S{0})];
  Lanes reached[sizes.transition()];
  Lanes value[sizes.value()];
  Lanes reach[sizes.reach()];
  Lanes pivots_hold[1];
  Lanes smallest_ratio[1];
};

/// Solves the equalities for the dependent entries of Z. Rows and columns come in an order in which no exchange is
/// needed, see elimination_plan.hpp.
template <class S>
DMOCBENCH_INLINE void eliminate_equalities(const S& shape, const Lanes* local, const double* pivot_scales,
                                           StepWork<S>& work) {
  const int n = shape.rows;
  const int columns = next_size(shape) + state_size(shape) + 1;
  Lanes* const a = work.equalities;
  for (int i = 0; i < n * columns; ++i) a[i] = local[i];
  for (int p = 0; p < n; ++p) {
    const Lanes pivot = a[p + p * n];
    *work.smallest_ratio = least_so_far(*work.smallest_ratio, magnitude(pivot) * Lanes::all(pivot_scales[p]));
    work.reciprocals[p] = Lanes::all(1.0) / pivot;
    for (int i = p + 1; i < n; ++i) {
      const Lanes factor = a[i + p * n] * work.reciprocals[p];
      a[i + p * n] = factor;
      for (int j = p + 1; j < columns; ++j) a[i + j * n] -= factor * a[p + j * n];
    }
  }
  for (int j = n; j < columns; ++j) {
    for (int p = n - 1; p >= 0; --p) {
      Lanes sum = a[p + j * n];
      for (int q = p + 1; q < n; ++q) sum -= a[p + q * n] * a[q + j * n];
      a[p + j * n] = sum * work.reciprocals[p];
    }
  }
}

/// Z and the next state as linear functions of (w, X, 1).
template <class S>
DMOCBENCH_INLINE void make_transition(const S& shape, const LocalBlocks<S>& blocks, const Lanes* local,
                                      const int* node_in_next, StepWork<S>& work) {
  const int n = shape.rows;
  const int Z = next_size(shape);
  const int X = state_size(shape);
  const int w = free_size(shape);
  const int N = column_count(shape);
  const Lanes zero{};
  const Lanes one = Lanes::all(1.0);
  for (int j = 0; j < N; ++j) {
    for (int i = 0; i < n; ++i) work.next[i + j * Z] = -work.equalities[i + (n + j) * n];
    for (int i = 0; i < w; ++i) work.next[n + i + j * Z] = i == j ? one : zero;
  }
  for (int j = 0; j < N; ++j) {
    Lanes* const column = work.transition + j * X;
    for (int i = 0; i < shape.node; ++i) column[i] = work.next[node_in_next[i] + j * Z];
    for (int i = 0; i < shape.carried; ++i) {
      Lanes sum = j >= w && j < w + shape.node ? local[blocks.carry(i, j - w)] : zero;
      for (int z = 0; z < Z; ++z) sum += local[blocks.carry(i, shape.node + z)] * work.next[z + j * Z];
      column[shape.node + i] = sum;
    }
    for (int i = 0; i < shape.shared; ++i) {
      column[shape.node + shape.carried + i] = j == w + shape.node + shape.carried + i ? one : zero;
    }
  }
}

/// True where the dependent entries of Z are the next node's unknowns, in their order (the elimination plan sees to
/// it): their Hessian then joins that of the rest before the transition is applied, instead of being applied twice.
template <class S>
inline constexpr bool joins_rest = false;
template <int node, int carried, int shared, int inner>
inline constexpr bool joins_rest<FixedShape<node, carried, shared, inner, node>> = true;

/// Derivatives of interval and rest with respect to Z and to the next state, as functions of (w, X, 1).
template <class S>
DMOCBENCH_INLINE void differentiate_interval(const S& shape, const LocalBlocks<S>& blocks, const Lanes* local,
                                             StepWork<S>& work) {
  const int n = shape.rows;
  const int Z = next_size(shape);
  const int X = state_size(shape);
  const int w = free_size(shape);
  const Lanes* const hessian = local + blocks.hessian();
  const auto direct = [&](int i, int j) { return hessian[i + (j < w ? n + j : Z + j - w) * Z]; };
  for (int j = 0; j < column_count(shape); ++j) {
    for (int i = joins_rest<S> ? n : 0; i < Z; ++i) {
      Lanes sum = direct(i, j);
      for (int z = 0; z < n; ++z) sum += hessian[i + z * Z] * work.next[z + j * Z];
      work.slope[i + j * Z] = sum;
    }
    const bool is_constant = j == column_count(shape) - 1;
    for (int i = 0; i < X; ++i) {
      Lanes sum = is_constant ? work.value[i + X * X] : Lanes{};
      if (joins_rest<S> && i < n) sum += direct(i, j);
      for (int x = 0; x < X; ++x) {
        const Lanes curvature =
            joins_rest<S> && i < n && x < n ? work.value[i + x * X] + hessian[i + x * Z] : work.value[i + x * X];
        sum += curvature * work.transition[x + j * X];
      }
      work.weighted[i + j * X] = sum;
    }
  }
}

/// An inequality whose slack is eliminated adds its square, weighted by 1/e, to the quadratic form: to its derivative
/// with respect to Z, and to the part of the condensed form that reads X directly.
template <class S>
DMOCBENCH_INLINE void add_inequality(const S& shape, const LocalBlocks<S>& blocks, const Lanes* local, int row,
                                     StepWork<S>& work) {
  const int Z = next_size(shape);
  const int w = free_size(shape);
  const int N = column_count(shape);
  Lanes* const line = work.line;
  const Lanes weight = Lanes::all(1.0) / local[blocks.softness() + row];
  for (int j = 0; j < N; ++j) {
    Lanes sum = j < w ? local[blocks.soft(row, shape.rows + j)] : local[blocks.soft(row, Z + j - w)];
    for (int z = 0; z < shape.rows; ++z) sum += local[blocks.soft(row, z)] * work.next[z + j * Z];
    line[j] = weight * sum;
    for (int z = 0; z < Z; ++z) {
      Lanes& slope = joins_rest<S> && z < shape.rows ? work.weighted[z + j * state_size(shape)] : work.slope[z + j * Z];
      slope += local[blocks.soft(row, z)] * line[j];
    }
  }
  for (int x = 0; x < state_size(shape); ++x) {
    for (int i = w + x; i < N; ++i) work.condensed[i + (w + x) * N] += local[blocks.soft(row, Z + x)] * line[i];
  }
}

/// The quadratic form of the interval and of all that follows, in (w, X, 1).
template <class S>
DMOCBENCH_INLINE void condense(const S& shape, const LocalBlocks<S>& blocks, const Lanes* local, StepWork<S>& work) {
  const int n = shape.rows;
  const int Z = next_size(shape);
  const int X = state_size(shape);
  const int w = free_size(shape);
  const int N = column_count(shape);
  const Lanes* const hessian = local + blocks.hessian();
  differentiate_interval(shape, blocks, local, work);
  for (int i = 0; i < N * N; ++i) work.condensed[i] = Lanes{};
  for (int row = 0; row < shape.soft; ++row) add_inequality(shape, blocks, local, row, work);
  for (int j = 0; j < w + X; ++j) {
    for (int i = j; i < N; ++i) {
      Lanes sum = work.condensed[i + j * N];
      for (int x = 0; x < X; ++x) sum += work.transition[x + j * X] * work.weighted[x + i * X];
      for (int z = 0; z < n && !joins_rest<S>; ++z) sum += work.next[z + j * Z] * work.slope[z + i * Z];
      if (j < w) {
        sum += work.slope[n + j + i * Z];
      } else {
        for (int z = 0; z < n; ++z) sum += hessian[z + (Z + j - w) * Z] * work.next[z + i * Z];
      }
      work.condensed[i + j * N] = sum;
    }
  }
  for (int j = 0; j < X; ++j) {
    for (int i = 0; i < N; ++i) {
      Lanes sum{};
      for (int x = 0; x < X; ++x) sum += work.transition[x + i * X] * work.value[x + (X + 1 + j) * X];
      work.reached[i + j * N] = sum;
    }
  }
}

/// Factors L D Lᵀ of the free unknowns' Hessian: what is eliminated stays in `condensed` and `reached`, the same
/// divided by the pivots goes to `scaled`. A pivot that is not positive is replaced, so that no other lane is
/// disturbed, and remembered.
template <class S>
DMOCBENCH_INLINE void factorise_free(const S& shape, StepWork<S>& work) {
  const int w = free_size(shape);
  const int X = state_size(shape);
  const int N = column_count(shape);
  const Lanes one = Lanes::all(1.0);
  Lanes* const c = work.condensed;
  Lanes* const scaled = work.scaled;
  for (int p = 0; p < w; ++p) {
    const Lanes diagonal = c[p + p * N];
    for (int q = 0; q < p; ++q) {
      for (int i = p; i < N; ++i) c[i + p * N] -= c[i + q * N] * scaled[q + p * w];
      for (int j = 0; j < X; ++j) work.reached[p + j * N] -= scaled[q + p * w] * work.reached[q + j * N];
    }
    Lanes pivot = c[p + p * N];
    // A pivot that is rounding of its diagonal entry is no pivot.
    const Lanes::Mask holds = pivot.v > (Lanes::all(smallest_pivot_share) * magnitude(diagonal)).v;
    *work.pivots_hold = smaller(*work.pivots_hold, chosen(holds, one, -one));
    pivot = chosen(holds, pivot, one);
    const Lanes reciprocal = one / pivot;
    for (int i = p + 1; i < N; ++i) scaled[p + i * w] = c[i + p * N] * reciprocal;
    for (int j = 0; j < X; ++j) scaled[p + (N + j) * w] = work.reached[p + j * N] * reciprocal;
  }
}

/// Value and reach of the segment with this interval in front; lanes that `active` leaves out keep theirs.
template <class S>
DMOCBENCH_INLINE void advance(const S& shape, bool all_active, const Lanes::Mask& active, StepWork<S>& work) {
  const int w = free_size(shape);
  const int X = state_size(shape);
  const int N = column_count(shape);
  const Lanes* const c = work.condensed;
  const Lanes* const scaled = work.scaled;
  const auto put = [&](Lanes& target, const Lanes& value) {
    target = all_active ? value : chosen(active, value, target);
  };
  for (int j = 0; j < X; ++j) {
    for (int i = j; i < X + 1; ++i) {
      Lanes sum = c[w + i + (w + j) * N];
      for (int q = 0; q < w; ++q) sum -= c[w + i + q * N] * scaled[q + (w + j) * w];
      if (i == X) {
        put(work.value[j + X * X], sum);
      } else {
        put(work.value[i + j * X], sum);
        put(work.value[j + i * X], sum);
      }
    }
    for (int i = 0; i < X + 1; ++i) {
      Lanes sum = work.reached[w + i + j * N];
      for (int q = 0; q < w; ++q) sum -= c[w + i + q * N] * scaled[q + (N + j) * w];
      if (i < X) {
        put(work.value[i + (X + 1 + j) * X], sum);
      } else {
        put(work.reach[j], work.reach[j] + sum);
      }
    }
    for (int i = j; i < X; ++i) {
      Lanes sum = work.reach[i + (1 + j) * X];
      for (int q = 0; q < w; ++q) sum += work.reached[q + i * N] * scaled[q + (N + j) * w];
      put(work.reach[i + (1 + j) * X], sum);
    }
  }
}
