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
  [[nodiscard]] constexpr int all() const {
    return equalities() + shape.rows + 2 * next() + 3 * transition() + condensed() + scaled() + column_count(shape);
  }
};

/// Numbers of lanes that are carried from step to step.
template <class S>
struct RestSizes {
  S shape;
  [[nodiscard]] constexpr int value() const { return state_size(shape) * (2 * state_size(shape) + 1); }
  [[nodiscard]] constexpr int reach() const { return state_size(shape) * (state_size(shape) + 1); }
  [[nodiscard]] constexpr int all() const { return value() + reach() + 2; }
};

/// What the steps backward carry from one to the next: the segment as far as it is eliminated.
template <class S>
struct Rest {
  Rest(const S& shape, Lanes* memory)
      : value(memory),
        reach(value + RestSizes<S>{shape}.value()),
        pivots_hold(reach + RestSizes<S>{shape}.reach()),
        smallest_ratio(pivots_hold + 1) {}

  Lanes* value;        // X x (X, 1, ν): P, p, Φ
  Lanes* reach;        // ν x (1, ν): γ, lower triangle of Γ
  Lanes* pivots_hold;  // 1, or -1 once one did not
  Lanes* smallest_ratio;
};

template <int... numbers>
struct Rest<FixedShape<numbers...>> {
  using S = FixedShape<numbers...>;
  static constexpr RestSizes<S> sizes{S{0}};
  Rest(const S& /*shape*/, Lanes* /*memory*/) {}

  Lanes value[sizes.value()];
  Lanes reach[sizes.reach()];
  Lanes pivots_hold[1];
  Lanes smallest_ratio[1];
};

/// Work of one step backward. All blocks are column by column. Where the shape is known to the compiler the blocks are
/// arrays in place, of which it knows that no two overlap, so that it can keep much of them in registers.
template <class S>
struct StepWork {
  StepWork(const S& s, Lanes* memory, const Rest<S>& rest_so_far) : shape(s), rest(rest_so_far) {
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
  }

  S shape;
  Rest<S> rest;
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
};

template <int... numbers>
struct StepWork<FixedShape<numbers...>> {
  using S = FixedShape<numbers...>;
  static constexpr StepSizes<S> sizes{S{0}};
  static constexpr int at_least_one(int count) { return count > 0 ? count : 1; }

  StepWork(const S& s, Lanes* /*memory*/, const Rest<S>& rest_so_far) : shape(s), rest(rest_so_far) {}

  S shape;
  Rest<S> rest;
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
};

/// The entry of Z that is entry i of x_{k+1}.
template <class S>
constexpr int next_of_node(const S& /*shape*/, const int* node_in_next, int i) {
  return is_always_plain<S> ? i : node_in_next[i];
}

/// Solves the equalities for the dependent entries of Z. Rows and columns come in an order in which no exchange is
/// needed, see elimination_plan.hpp.
template <class S>
DMOCBENCH_INLINE void eliminate_equalities(const S& shape, const Lanes* local, const int* node_in_next,
                                           const double* pivot_scales, StepWork<S>& work) {
  const int n = shape.rows;
  const int Z = next_size(shape);
  const int columns = Z + state_size(shape) + 1;
  Lanes* const a = work.equalities;
  for (int i = 0; i < n * columns; ++i) a[i] = local[i];
  for (int i = 0; i < shape.node; ++i) {
    if (!moves_by_increment(shape, node_in_next, i)) continue;
    for (int row = 0; row < n; ++row) a[row + (Z + i) * n] += a[row + next_of_node(shape, node_in_next, i) * n];
  }
  for (int p = 0; p < n; ++p) {
    const Lanes pivot = a[p + p * n];
    *work.rest.smallest_ratio = least_so_far(*work.rest.smallest_ratio, magnitude(pivot) * Lanes::all(pivot_scales[p]));
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

/// A dependent entry of Z as a function of (w, X, 1), column j.
template <class S>
DMOCBENCH_INLINE Lanes dependent_entry(const S& shape, const StepWork<S>& work, int entry, int j) {
  return is_always_plain<S> ? work.transition[entry + j * state_size(shape)] : work.next[entry + j * next_size(shape)];
}

/// What the rows of the next node receive, column j; the dependent entries in the work are increments still.
template <class S>
DMOCBENCH_INLINE void carry_on(const S& shape, const LocalBlocks<S>& blocks, const Lanes* local,
                               const int* node_in_next, int j, StepWork<S>& work) {
  const int n = shape.rows;
  const int w = free_size(shape);
  for (int row = 0; row < shape.carried; ++row) {
    Lanes sum = j < w ? local[blocks.carry(row, shape.node + n + j)] : Lanes{};
    for (int i = 0; i < shape.node; ++i) {
      if (moves_by_increment(shape, node_in_next, i)) {
        const int z = next_of_node(shape, node_in_next, i);
        sum -= local[blocks.carry(row, i)] * dependent_entry(shape, work, z, j);
      } else if (j == w + i) {
        sum += local[blocks.carry(row, i)];
      }
    }
    for (int z = 0; z < n && !is_always_plain<S>; ++z) {
      sum += local[blocks.carry(row, shape.node + z)] * dependent_entry(shape, work, z, j);
    }
    work.transition[shape.node + row + j * state_size(shape)] = sum;
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
  const Lanes zero{};
  const Lanes one = Lanes::all(1.0);
  for (int j = 0; j < column_count(shape); ++j) {
    Lanes* const column = work.transition + j * X;
    Lanes* const dependent = is_always_plain<S> ? column : work.next + j * Z;
    for (int i = 0; i < n; ++i) dependent[i] = -work.equalities[i + (n + j) * n];
    carry_on(shape, blocks, local, node_in_next, j, work);
    for (int i = 0; i < shape.node; ++i) {
      if (j == w + i && moves_by_increment(shape, node_in_next, i)) {
        dependent[next_of_node(shape, node_in_next, i)] += one;
      }
    }
    if (!is_always_plain<S>) {
      for (int i = 0; i < w; ++i) work.next[n + i + j * Z] = i == j ? one : zero;
      for (int i = 0; i < shape.node; ++i) column[i] = work.next[node_in_next[i] + j * Z];
    }
    for (int i = 0; i < shape.shared; ++i) {
      column[shape.node + shape.carried + i] = j == w + shape.node + shape.carried + i ? one : zero;
    }
  }
}

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
    for (int i = is_always_plain<S> ? n : 0; i < Z; ++i) {
      Lanes sum = direct(i, j);
      for (int z = 0; z < n; ++z) sum += hessian[i + z * Z] * dependent_entry(shape, work, z, j);
      work.slope[i + j * Z] = sum;
    }
    const bool is_constant = j == column_count(shape) - 1;
    for (int i = 0; i < X; ++i) {
      Lanes sum = is_constant ? work.rest.value[i + X * X] : Lanes{};
      if (is_always_plain<S> && i < n) sum += direct(i, j);
      for (int x = 0; x < X; ++x) {
        const Lanes curvature = is_always_plain<S> && i < n && x < n ? work.rest.value[i + x * X] + hessian[i + x * Z]
                                                                     : work.rest.value[i + x * X];
        sum += curvature * work.transition[x + j * X];
      }
      work.weighted[i + j * X] = sum;
    }
  }
}

/// An inequality as a function of (w, X, 1), weighted by 1/e.
template <class S>
DMOCBENCH_INLINE void weigh_inequality(const S& shape, const LocalBlocks<S>& blocks, const Lanes* local, int row,
                                       StepWork<S>& work) {
  const int Z = next_size(shape);
  const int w = free_size(shape);
  const int N = column_count(shape);
  Lanes* const line = work.line;
  const Lanes weight = Lanes::all(1.0) / local[blocks.compliance() + row];
  for (int j = 0; j < N; ++j) {
    Lanes sum = j < w ? local[blocks.inequality(row, shape.rows + j)] : local[blocks.inequality(row, Z + j - w)];
    for (int z = 0; z < shape.rows; ++z) sum += local[blocks.inequality(row, z)] * dependent_entry(shape, work, z, j);
    line[j] = weight * sum;
  }
}

/// An inequality whose slack is eliminated adds its square, weighted by 1/e, to the quadratic form: to its derivative
/// with respect to Z, and (`add_direct_inequality`) to the part of the condensed form that reads X directly.
template <class S>
DMOCBENCH_INLINE void add_inequality(const S& shape, const LocalBlocks<S>& blocks, const Lanes* local, int row,
                                     StepWork<S>& work) {
  weigh_inequality(shape, blocks, local, row, work);
  for (int j = 0; j < column_count(shape); ++j) {
    for (int z = 0; z < next_size(shape); ++z) {
      Lanes& slope = is_always_plain<S> && z < shape.rows ? work.weighted[z + j * state_size(shape)]
                                                          : work.slope[z + j * next_size(shape)];
      slope += local[blocks.inequality(row, z)] * work.line[j];
    }
  }
}

template <class S>
DMOCBENCH_INLINE void add_direct_inequality(const S& shape, const LocalBlocks<S>& blocks, const Lanes* local, int row,
                                            StepWork<S>& work) {
  const int w = free_size(shape);
  const int N = column_count(shape);
  weigh_inequality(shape, blocks, local, row, work);
  for (int x = 0; x < state_size(shape); ++x) {
    const Lanes derivative = local[blocks.inequality(row, next_size(shape) + x)];
    for (int i = w + x; i < N; ++i) work.condensed[i + (w + x) * N] += derivative * work.line[i];
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
  for (int row = 0; row < shape.inequalities; ++row) add_inequality(shape, blocks, local, row, work);
  for (int j = 0; j < w + X; ++j) {
    for (int i = j; i < N; ++i) {
      Lanes sum{};
      for (int x = 0; x < X; ++x) sum += work.transition[x + j * X] * work.weighted[x + i * X];
      for (int z = 0; z < n && !is_always_plain<S>; ++z) sum += work.next[z + j * Z] * work.slope[z + i * Z];
      if (j < w) {
        sum += work.slope[n + j + i * Z];
      } else {
        for (int z = 0; z < n; ++z) sum += hessian[z + (Z + j - w) * Z] * dependent_entry(shape, work, z, i);
      }
      work.condensed[i + j * N] = sum;
    }
  }
  for (int row = 0; row < shape.inequalities; ++row) add_direct_inequality(shape, blocks, local, row, work);
  for (int j = 0; j < X; ++j) {
    for (int i = 0; i < N; ++i) {
      Lanes sum{};
      for (int x = 0; x < X; ++x) sum += work.transition[x + i * X] * work.rest.value[x + (X + 1 + j) * X];
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
    *work.rest.pivots_hold = smaller(*work.rest.pivots_hold, chosen(holds, one, -one));
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
        put(work.rest.value[j + X * X], sum);
      } else {
        put(work.rest.value[i + j * X], sum);
        put(work.rest.value[j + i * X], sum);
      }
    }
    for (int i = 0; i < X + 1; ++i) {
      Lanes sum = work.reached[w + i + j * N];
      for (int q = 0; q < w; ++q) sum -= c[w + i + q * N] * scaled[q + (N + j) * w];
      if (i < X) {
        put(work.rest.value[i + (X + 1 + j) * X], sum);
      } else {
        put(work.rest.reach[j], work.rest.reach[j] + sum);
      }
    }
    for (int i = j; i < X; ++i) {
      Lanes sum = work.rest.reach[i + (1 + j) * X];
      for (int q = 0; q < w; ++q) sum += work.reached[q + i * N] * scaled[q + (N + j) * w];
      put(work.rest.reach[i + (1 + j) * X], sum);
    }
  }
}
