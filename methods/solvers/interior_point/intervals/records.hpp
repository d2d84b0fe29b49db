// Included by segment_kernel.cpp alone, see lanes.hpp.

/// L⁻ᵀ applied to what `factorise_free` left: w = -(gain)(X, 1, ν).
template <class S>
DMOCBENCH_INLINE void store_gain(const S& shape, const StepWork<S>& work, Lanes* gain) {
  const int w = free_size(shape);
  for (int j = 0; j < 2 * state_size(shape) + 1; ++j) {
    for (int p = w - 1; p >= 0; --p) {
      Lanes sum = work.scaled[p + (w + j) * w];
      for (int q = p + 1; q < w; ++q) sum -= work.scaled[p + q * w] * gain[q + j * w];
      gain[p + j * w] = sum;
    }
  }
}

/// The slope that the multipliers of the interval's equalities balance, before `advance` replaces the value of the
/// rest.
template <class S>
DMOCBENCH_INLINE void store_slope(const S& shape, const LocalBlocks<S>& blocks, const Lanes* local,
                                  const int* node_in_next, const StepWork<S>& work, Lanes* slope) {
  const int n = shape.rows;
  const int X = state_size(shape);
  const int N = column_count(shape);
  const auto add_rest = [&](const Lanes* derivative, Lanes* column) {
    for (int i = 0; i < shape.node; ++i) {
      if (node_in_next[i] < n) column[node_in_next[i]] += derivative[i];
    }
    for (int i = 0; i < shape.carried; ++i) {
      for (int z = 0; z < n && !is_always_plain<S>; ++z) {
        column[z] += local[blocks.carry(i, shape.node + z)] * derivative[shape.node + i];
      }
      for (int x = 0; x < shape.node; ++x) {
        if (!moves_by_increment(shape, node_in_next, x)) continue;
        column[next_of_node(shape, node_in_next, x)] -= local[blocks.carry(i, x)] * derivative[shape.node + i];
      }
    }
  };
  for (int j = 0; j < N; ++j) {
    for (int z = 0; z < n; ++z) slope[z + j * n] = is_always_plain<S> ? Lanes{} : work.slope[z + j * next_size(shape)];
    add_rest(work.weighted + j * X, slope + j * n);
  }
  for (int j = 0; j < X; ++j) {
    Lanes* const column = slope + (N + j) * n;
    for (int z = 0; z < n; ++z) column[z] = Lanes{};
    add_rest(work.rest.value + (X + 1 + j) * X, column);
  }
}

template <class S>
DMOCBENCH_INLINE void store_transition(const S& shape, const StepWork<S>& work, Lanes* transition, Lanes* dependent) {
  const int X = state_size(shape);
  const int kept = shape.node + shape.carried;
  for (int j = 0; j < column_count(shape); ++j) {
    for (int i = 0; i < kept; ++i) transition[i + j * kept] = work.transition[i + j * X];
    for (int i = 0; i < shape.rows && !is_always_plain<S>; ++i) {
      dependent[i + j * shape.rows] = work.next[i + j * next_size(shape)];
    }
  }
}

/// Multipliers of the rows of a node: the derivative of the value with respect to s.
template <class S>
DMOCBENCH_INLINE void store_multipliers(const S& shape, const StepWork<S>& work, Lanes* multipliers) {
  const int X = state_size(shape);
  for (int j = 0; j < 2 * X + 1; ++j) {
    for (int i = 0; i < shape.carried; ++i)
      multipliers[i + j * shape.carried] = work.rest.value[shape.node + i + j * X];
  }
}

template <class S>
DMOCBENCH_INLINE void store_factors(const S& shape, const StepWork<S>& work, Lanes* factors) {
  const int n = shape.rows;
  for (int i = 0; i < n * n; ++i) factors[i] = work.equalities[i];
  for (int i = 0; i < n; ++i) factors[n * n + i] = work.reciprocals[i];
}

/// Eᵀ x = b for the factors E = L U of the equalities, in place.
template <class S>
DMOCBENCH_INLINE void solve_transposed(const S& shape, const Lanes* factors, Lanes* x) {
  const int n = shape.rows;
  for (int p = 0; p < n; ++p) {
    for (int q = 0; q < p; ++q) x[p] -= factors[q + p * n] * x[q];
    x[p] = x[p] * factors[n * n + p];
  }
  for (int p = n - 1; p >= 0; --p) {
    for (int q = p + 1; q < n; ++q) x[p] -= factors[q + p * n] * x[q];
  }
}
