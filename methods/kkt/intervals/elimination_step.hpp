#pragma once

#include "methods/kkt/intervals/kernel_blocks.hpp"
#include "methods/kkt/intervals/products.hpp"

// One step of both sweeps, by the formulas of README.md, as products of matrices (products.hpp). `is_always_plain<S>`
// means that the sizes are known at compile time: every entry of a result is then finished before the next one, and
// stored once, so that operands live in registers. Otherwise every product is carried out as a whole.
// NOLINTBEGIN(*-avoid-c-arrays): arrays that live in registers
namespace dmocbench::kkt {
inline namespace DMOCBENCH_LANES {

/// Inequalities that are worked on at once. Their number is unknown at compile time for all shapes.
template <class S>
inline constexpr auto line_count = [](const auto& shape)
                                       DMOCBENCH_INLINED { return is_always_plain<S> ? 1 : shape.inequalities; };

/// Work of one step backward.
template <class S>
struct StepWork {
  StepWork(const S& shape, Memory& memory)
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

  /// The next state as a function of (w, X, 1).
  [[nodiscard]] DMOCBENCH_INLINE Block transition() {
    if constexpr (is_always_plain<S>) return block(whole_transition);
    return made_transition;
  }
  /// The dependent entries of Z as functions of (w, X, 1).
  [[nodiscard]] DMOCBENCH_INLINE Block dependent(const S& shape) {
    return is_plain(shape) ? transition() : block(next);
  }

  LaneMatrix<S, row_count, local_column_count<S>> equalities;      // n x (Z, X, 1): factors; then dependent Z, negative
  LaneMatrix<S, row_count, one_column> reciprocals;                // of the pivots
  LaneMatrix<S, next_size<S>, column_count<S>> next;               // Z as a function of (w, X, 1), unless it is plain
  LaneMatrix<S, sum_count, row_count> of_dependent;                // the next s as a function of dependent Z, negative
  LaneMatrix<S, next_size<S>, column_count<S>> gradient;           // of the interval's own cost with respect to Z
  Block made_transition{nullptr, 1, 0};                            // where `transition` is, if sizes are unknown
  LaneMatrix<S, state_size<S>, column_count<S>> whole_transition;  // its place if the record lacks rows of it
  LaneMatrix<S, state_size<S>, column_count<S>> costate;           // derivative of the next state's cost, of (w, X, 1)
  LaneMatrix<S, line_count<S>, column_count<S>> lines;             // inequalities, weighted by 1/e
  LaneMatrix<S, column_count<S>, column_count<S>>
      condensed;                                       // quadratic form of interval and cost-to-go; lower triangle
  LaneMatrix<S, free_size<S>, scaled_columns> scaled;  // w x (w, X, 1, ν): eliminated rows divided by pivots
  LaneMatrix<S, column_count<S>, state_size<S>> last_state;  // (w, X, 1) x ν
  LaneMatrix<S, state_size<S>, state_size<S>> reachability;  // ν x ν: the last Γ, lower triangle
};

/// Rows and columns that are eliminated one by one, between products that eliminate all before them at once. Known
/// sizes are smaller than a block.
template <class S>
inline constexpr int block_size = is_always_plain<S> ? 16 : 4;

/// Solves U x = b for every column of `start`; U is `size` x `size`. Unit diagonal if `reciprocals` is null, else
/// `reciprocals` holds its inverse. If sizes are unknown, `start` is `right`.
template <class S>
DMOCBENCH_INLINE void solve_upper(const ConstBlock& U, const Lanes* reciprocals, int size, int columns,
                                  const Block& start, const Block& right) {
  for (int begin = (size - 1) / block_size<S> * block_size<S>; begin >= 0; begin -= block_size<S>) {
    const int end = begin + block_size<S> < size ? begin + block_size<S> : size;
    if constexpr (!is_always_plain<S>) {
      subtract_product<S>(right.from(begin, 0), U.from(begin, end), right.from(end, 0),
                          {end - begin, columns, size - end});
    }
    for (int j = 0; j < columns; ++j) {
      for (int p = end - 1; p >= begin; --p) {
        Lanes sum = start(p, j);
        for (int q = p + 1; q < end; ++q) sum -= U(p, q) * right(q, j);
        right(p, j) = reciprocals == nullptr ? sum : sum * reciprocals[p];
      }
    }
  }
}

/// Factors of the first `rows` columns of E, L U with the unit diagonal in L, in place; the others become L⁻¹ E.
template <class S>
DMOCBENCH_INLINE void factorise_equalities(const LocalSystem<S>& local, CostToGo<S>& V, StepWork<S>& work) {
  const int n = local.shape.rows;
  const int columns = local_column_count(local.shape);
  const Block E = block(work.equalities);
  for (int begin = 0; begin < n; begin += block_size<S>) {
    const int end = begin + block_size<S> < n ? begin + block_size<S> : n;
    if constexpr (!is_always_plain<S>) {
      subtract_product<S>(E.from(begin, begin), E.from(begin, 0), E.from(0, begin),
                          {end - begin, columns - begin, begin});
      subtract_product<S>(E.from(end, begin), E.from(end, 0), E.from(0, begin), {n - end, end - begin, begin});
    }
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
template <class S>
DMOCBENCH_INLINE void eliminate_equalities(const LocalSystem<S>& local, CostToGo<S>& V, StepWork<S>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  copy(local.equality.first, n * (Z + X + 1), work.equalities.data());
  for (int i = 0; i < local.shape.node; ++i) {
    if (!local.moves_by_increment(i)) continue;
    for (int row = 0; row < n; ++row) work.equalities(row, Z + i) += work.equalities(row, local.next_of_node(i));
  }
  factorise_equalities(local, V, work);
  const Block E = block(work.equalities);
  solve_upper<S>(E, work.reciprocals.data(), n, N, E.from(0, n), E.from(0, n));
}

/// The next s as a function of the dependent entries of Z while they are increments, negative.
template <class S>
DMOCBENCH_INLINE ConstBlock of_dependent(const LocalSystem<S>& local, StepWork<S>& work) {
  if constexpr (is_always_plain<S>) return block(local.carry);  // of them, s reads increments of x
  return block(work.of_dependent);
}

/// The contributions to the rows of the next node. The dependent entries in the work are still increments.
template <class S>
DMOCBENCH_INLINE void sum_at_next_node(const LocalSystem<S>& local, int first, int count, StepWork<S>& work) {
  const S& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  if (shape.node_sums == 0) return;
  const Block sums = work.transition().from(shape.node, 0);
  for (int j = first; j < first + count; ++j) {
    for (int row = 0; row < shape.node_sums; ++row) {
      sums(row, j) = j < w ? local.carry(row, shape.node + n + j) : Lanes{};
    }
  }
  if constexpr (!is_always_plain<S>) {
    for (int row = 0; row < shape.node_sums; ++row) {
      for (int z = 0; z < n; ++z) work.of_dependent(row, z) = -local.carry(row, shape.node + z);
      for (int i = 0; i < shape.node; ++i) {
        if (local.moves_by_increment(i)) {
          work.of_dependent(row, local.next_of_node(i)) += local.carry(row, i);
        } else {
          sums(row, w + i) = local.carry(row, i);
        }
      }
    }
  }
  subtract_product<S>(sums.from(0, first), of_dependent(local, work), work.dependent(shape).from(0, first),
                      {shape.node_sums, count, n});
}

/// Z and the next state as linear functions of (w, X, 1). The next state is made in the record where it stands there as
/// it is.
template <class S>
DMOCBENCH_INLINE void make_transition(const LocalSystem<S>& local, StepWork<S>& work, Lanes* record) {
  const S& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  if constexpr (!is_always_plain<S>) {
    const MatrixView<Lanes> recorded = view(record, RecordBlocks<Shape>{shape}.transition());
    work.made_transition = shape.global == 0 ? block(recorded) : block(work.whole_transition);
  }
  const Lanes zero{};
  const Lanes one = Lanes::all(1.0);
  const Block transition = work.transition();
  const Block dependent = work.dependent(shape);
  for_ranges<S>(N, [&, n = n, X = X, w = w](int first, int count) DMOCBENCH_INLINED {
    for (int j = first; j < first + count; ++j) {
      for (int i = 0; i < n; ++i) dependent(i, j) = -work.equalities(i, n + j);
    }
    sum_at_next_node(local, first, count, work);
    for (int j = first; j < first + count; ++j) {
      if (j >= w && j - w < shape.node && local.moves_by_increment(j - w)) {
        dependent(local.next_of_node(j - w), j) += one;
      }
      if (!is_plain(shape)) {
        for (int i = 0; i < w; ++i) work.next(n + i, j) = i == j ? one : zero;
        for (int i = 0; i < shape.node; ++i) transition(i, j) = work.next(local.node_in_next[i], j);
      }
      for (int i = shape.node + shape.node_sums; i < X; ++i) transition(i, j) = j == w + i ? one : zero;
    }
  });
}

/// Derivatives of the interval's cost with respect to Z, and of the cost-to-go with respect to the next state, as
/// functions of (w, X, 1). If the shape is plain, the dependent entries of Z are part of the next state, and their
/// derivatives of that state: the Hessian of the interval is added to the Hessian of the cost-to-go, which `advance`
/// replaces, in the active lanes only.
template <class S>
DMOCBENCH_INLINE void differentiate_interval(const LocalSystem<S>& local, const Lanes::Mask* active, CostToGo<S>& V,
                                             StepWork<S>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  const ConstBlock H = block(local.hessian);
  const int of_state = is_plain(local.shape) ? n : 0;
  const auto direct = [&, n = n, Z = Z, w = w](int i, int j)
                          DMOCBENCH_INLINED -> const Lanes& { return H(i, j < w ? n + j : Z + j - w); };
  const auto add_terms = [&, N = N](int i, int j, Lanes& sum) DMOCBENCH_INLINED {
    if (j == N - 1) sum += V.p(i);
    if (i < of_state) sum += direct(i, j);
  };
  if constexpr (is_always_plain<S>) {
    const auto curvature = [&, n = n](int i, int x)
                               DMOCBENCH_INLINED { return i < n && x < n ? V.P(i, x) + H(i, x) : V.P(i, x); };
    set_product_and_terms<S>(block(work.costate), curvature, work.transition(), {X, N, X}, add_terms);
  } else {
    for (int j = 0; j < of_state; ++j) {
      for (int i = 0; i < of_state; ++i) V.P(i, j) += active == nullptr ? H(i, j) : chosen(*active, H(i, j), Lanes{});
    }
    set_product_and_terms<S>(block(work.costate), block(V.value), work.transition(), {X, N, X}, add_terms);
  }
  const Block gradient = block(work.gradient).from(of_state, 0);
  for_tiles<S>({Z - of_state, N, n}, [&](int first, int begin, const ProductSizes& sizes) DMOCBENCH_INLINED {
    for (int j = begin; j < begin + sizes.columns; ++j) {
      for (int i = first; i < first + sizes.rows; ++i) gradient(i, j) = direct(of_state + i, j);
    }
    add_product<S>(gradient.from(first, begin), H.from(of_state + first, 0), work.dependent(local.shape).from(0, begin),
                   sizes);
  });
}

/// Inequalities as functions of (w, X, 1), weighted by 1/e.
template <class S>
DMOCBENCH_INLINE void weigh_inequalities(const LocalSystem<S>& local, int first, int rows, StepWork<S>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  const ConstBlock C = block(local.inequality).from(first, 0);
  const Block lines = block(work.lines);
  for (int j = 0; j < N; ++j) {
    for (int row = 0; row < rows; ++row) lines(row, j) = C(row, j < w ? n + j : Z + j - w);
  }
  add_product<S>(lines, C, work.dependent(local.shape), {rows, N, n});
  for (int row = 0; row < rows; ++row) {
    const Lanes weight = Lanes::all(1.0) / local.compliance(first + row);
    for (int j = 0; j < N; ++j) lines(row, j) = weight * lines(row, j);
  }
}

/// An inequality whose slack is eliminated adds its square, weighted by 1/e, to the quadratic form. This adds the
/// derivative of the squares with respect to Z.
template <class S>
DMOCBENCH_INLINE void add_inequalities(const LocalSystem<S>& local, StepWork<S>& work) {
  for_ranges<S>(local.shape.inequalities, [&](int first, int rows) DMOCBENCH_INLINED {
    const auto [n, Z, X, w, N] = sizes_of(local.shape);
    weigh_inequalities(local, first, rows, work);
    const ConstBlock C = block(local.inequality).from(first, 0);
    const int of_state = is_plain(local.shape) ? n : 0;
    add_product<S>(block(work.costate), C.transposed(), block(work.lines), {of_state, N, rows});
    add_product<S>(block(work.gradient).from(of_state, 0), C.from(0, of_state).transposed(), block(work.lines),
                   {Z - of_state, N, rows});
  });
}

/// The quadratic form of the interval and of the cost-to-go, in (w, X, 1).
template <class S>
DMOCBENCH_INLINE void condense(const LocalSystem<S>& local, const Lanes::Mask* active, CostToGo<S>& V,
                               StepWork<S>& work) {
  const S& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  differentiate_interval(local, active, V, work);
  add_inequalities(local, work);
  const Block form = block(work.condensed);
  const Block transition = work.transition();
  const Block dependent = work.dependent(shape);
  const Block costate = block(work.costate);
  const Block gradient = block(work.gradient);
  if constexpr (!is_always_plain<S>) clear_above_diagonal(form, N);
  const ConstBlock H = block(local.hessian).from(0, Z);
  const auto set_form = [&, n = n](int i, int j, const ProductSizes& sizes) DMOCBENCH_INLINED {
    set_product<S>(form.from(i, j), costate.from(0, i).transposed(), transition.from(0, j), sizes);
    if (!is_plain(shape)) {
      add_product<S>(form.from(i, j), gradient.from(0, i).transposed(), dependent.from(0, j), sizes.of_depth(n));
    }
  };
  for_tiles<S>({N, w, X, Part::lower}, [&, n = n](int i, int j, const ProductSizes& sizes) DMOCBENCH_INLINED {
    set_form(i, j, sizes);
    for_entries(sizes, [&](int k, int l) DMOCBENCH_INLINED { form(i + k, j + l) += gradient(n + j + l, i + k); });
  });
  for_tiles<S>(
      {N - w, X, X, Part::lower}, [&, n = n, w = w](int i, int j, const ProductSizes& sizes) DMOCBENCH_INLINED {
        set_form(w + i, w + j, sizes);
        add_product<S>(form.from(w + i, w + j), dependent.from(0, w + i).transposed(), H.from(0, j), sizes.of_depth(n));
      });
  for_ranges<S>(shape.inequalities, [&, Z = Z, X = X, w = w, N = N](int first, int rows) DMOCBENCH_INLINED {
    if constexpr (is_always_plain<S>) weigh_inequalities(local, first, rows, work);
    add_product<S>(form.from(w, w), block(work.lines).from(0, w).transposed(), block(local.inequality).from(first, Z),
                   {N - w, X, rows, Part::lower});
  });
  set_product<S>(block(work.last_state), transition.transposed(), block(V.value).from(0, X + 1), {N, X, X});
}

/// Eliminates one free unknown from the rows of its block: `factorise_free`. `diagonal` is its entry of the Hessian.
template <class S>
DMOCBENCH_INLINE void eliminate_free(const S& shape, int p, const Lanes& diagonal, CostToGo<S>& V, StepWork<S>& work) {
  const int X = state_size(shape);
  const int N = column_count(shape);
  const Lanes reciprocal = Lanes::all(1.0) / V.signs.note(work.condensed(p, p), diagonal);
  for (int i = p + 1; i < N; ++i) work.scaled(p, i) = work.condensed(i, p) * reciprocal;
  for (int j = 0; j < X; ++j) work.scaled(p, N + j) = work.last_state(p, j) * reciprocal;
}

/// Factors L D Lᵀ of the free unknowns' Hessian: the eliminated rows stay in `condensed` and `last_state`, the same
/// divided by the pivots goes to `scaled`.
template <class S>
DMOCBENCH_INLINE void factorise_free(const S& shape, CostToGo<S>& V, StepWork<S>& work) {
  const auto [n, Z, X, w, N] = sizes_of(shape);
  const Block C = block(work.condensed);
  const Block nu = block(work.last_state);
  const Block scaled = block(work.scaled);
  for (int begin = 0; begin < w; begin += block_size<S>) {
    const int end = begin + block_size<S> < w ? begin + block_size<S> : w;
    Lanes diagonal[block_size<S>];
    for (int p = begin; p < end; ++p) diagonal[p - begin] = C(p, p);
    if constexpr (!is_always_plain<S>) {
      subtract_product<S>(C.from(begin, begin), C.from(begin, 0), scaled.from(0, begin),
                          {N - begin, end - begin, begin});
      subtract_product<S>(nu.from(begin, 0), scaled.from(0, begin).transposed(), nu, {end - begin, X, begin});
    }
    for (int p = begin; p < end; ++p) {
      for (int q = begin; q < p; ++q) {
        for (int i = p; i < N; ++i) C(i, p) -= C(i, q) * scaled(q, p);
        for (int j = 0; j < X; ++j) nu(p, j) -= scaled(q, p) * nu(q, j);
      }
      eliminate_free(shape, p, diagonal[p - begin], V, work);
    }
  }
}

/// The cost-to-go with this interval in front; `put(target, value)` sets an entry of it.
template <class S, class Put>
DMOCBENCH_INLINE void advance_by(const Put& put, const S& shape, StepWork<S>& work, CostToGo<S>& V) {
  const auto [n, Z, X, w, N] = sizes_of(shape);
  const Block eliminated = block(work.condensed).from(w, 0);
  const Block scaled_nu = block(work.scaled).from(0, N);
  put_difference<S>(block(work.condensed).from(w, w), eliminated, block(work.scaled).from(0, w),
                    {X + 1, X, w, Part::lower}, [&, X = X](int i, int j, const Lanes& sum) DMOCBENCH_INLINED {
                      if (i == X) return put(V.p(j), sum);
                      put(V.P(i, j), sum);
                      put(V.P(j, i), sum);
                    });
  put_difference<S>(block(work.last_state).from(w, 0), eliminated, scaled_nu, {X + 1, X, w},
                    [&, X = X](int i, int j, const Lanes& sum) DMOCBENCH_INLINED {
                      if (i == X) return put(V.gamma(j), V.gamma(j) + sum);
                      put(V.Phi(i, j), sum);
                    });
  add_product<S>({&V.Gamma(0, 0), 1, X}, block(work.last_state).transposed(), scaled_nu, {X, X, w, Part::lower});
}

/// The same of the active lanes.
template <class S>
DMOCBENCH_INLINE void advance(const S& shape, const Lanes::Mask* active, StepWork<S>& work, CostToGo<S>& V) {
  if (active == nullptr) {
    return advance_by([](Lanes& target, const Lanes& value) DMOCBENCH_INLINED { target = value; }, shape, work, V);
  }
  const int X = state_size(shape);
  copy(&V.Gamma(0, 0), X * X, work.reachability.data());
  advance_by([&](Lanes& target, const Lanes& value) DMOCBENCH_INLINED { target = chosen(*active, value, target); },
             shape, work, V);
  for_entries({X, X, 0, Part::lower}, [&](int i, int j) DMOCBENCH_INLINED {
    V.Gamma(i, j) = chosen(*active, V.Gamma(i, j), work.reachability(i, j));
  });
}

/// w = -(gain)(X, 1, ν): L⁻ᵀ applied to the result of `factorise_free`.
template <class S>
DMOCBENCH_INLINE void store_gain(const S& shape, StepWork<S>& work, const MatrixView<Lanes>& gain) {
  const int w = free_size(shape);
  const int columns = 2 * state_size(shape) + 1;
  if constexpr (!is_always_plain<S>) copy(&work.scaled(0, w), w * columns, gain.first);
  const Block start = is_always_plain<S> ? block(work.scaled).from(0, w) : block(gain);
  solve_upper<S>(block(work.scaled), nullptr, w, columns, start, block(gain));
}

template <class S>
DMOCBENCH_INLINE void store_transition(const S& shape, StepWork<S>& work, Lanes* record) {
  const RecordBlocks<S> places{shape};
  const int columns = column_count(shape);
  if (is_always_plain<S> || shape.global > 0) {
    copy_columns(work.transition(), columns, view(record, places.transition()));
  }
  if (!is_plain(shape)) copy_columns(work.next, columns, view(record, places.dependent()));
}

/// The gradient that the multipliers of the interval's equalities balance; before `advance`.
template <class S>
DMOCBENCH_INLINE void store_gradient(const LocalSystem<S>& local, CostToGo<S>& V, StepWork<S>& work,
                                     const MatrixView<Lanes>& gradient) {
  const S& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  for (int j = 0; j < N + X; ++j) {
    const Lanes* const of_next = j < N ? &work.costate(0, j) : &V.Phi(0, j - N);
    for (int z = 0; z < n; ++z) gradient(z, j) = j < N && !is_plain(shape) ? work.gradient(z, j) : Lanes{};
    for (int i = 0; i < shape.node; ++i) {
      const int z = local.next_of_node(i);
      if (z < n) gradient(z, j) += of_next[i];
    }
  }
  if (shape.node_sums == 0) return;
  const ConstBlock of_sums = of_dependent(local, work).transposed();
  subtract_product<S>(block(gradient), of_sums, block(work.costate).from(shape.node, 0), {n, N, shape.node_sums});
  subtract_product<S>(block(gradient).from(0, N), of_sums, block(V.value).from(shape.node, X + 1),
                      {n, X, shape.node_sums});
}

/// Eᵀ x = b for the factors E = L U of the equalities, in place.
template <class S>
DMOCBENCH_INLINE void solve_transposed(const S& shape, const MatrixView<const Lanes>& E, Lanes* x) {
  const int n = shape.rows;
  for (int p = 0; p < n; ++p) {
    for (int q = 0; q < p; ++q) x[p] -= E(q, p) * x[q];
    x[p] = x[p] * E(p, n);
  }
  for (int p = n - 1; p >= 0; --p) {
    for (int q = p + 1; q < n; ++q) x[p] -= E(q, p) * x[q];
  }
}

/// One step: free unknowns, next state, dependent unknowns and multipliers from the state and ν.
template <class S>
inline void step_forward(const S& shape, const Lanes* record, const Lanes* nu, Lanes* work) {
  const RecordBlocks<S> places{shape};
  const ForwardBlocks<S> results{shape};
  const auto [n, Z, X, w, N] = sizes_of(shape);
  Lanes* const columns = work + results.columns().first;
  const Lanes* const state = columns + w;  // (X, 1)
  Lanes* const next_state = work + results.next_state().first;
  Lanes* const multipliers = work + results.multipliers().first;
  const auto apply = [&](const BlockPlace& place, const Lanes* to, int size, Lanes* result) DMOCBENCH_INLINED {
    set_product<S>(column(result), block(view(record, place)), column(to), {place.rows, 1, size});
  };
  const auto apply_with_nu = [&, X = X](const BlockPlace& place, const Lanes* to, int size,
                                        Lanes* result) DMOCBENCH_INLINED {
    const ConstBlock matrix = block(view(record, place));
    for_ranges<S>(place.rows, [&](int first, int rows) DMOCBENCH_INLINED {
      set_product<S>(column(result + first), matrix.from(first, 0), column(to), {rows, 1, size});
      add_product<S>(column(result + first), matrix.from(first, size), column(nu), {rows, 1, X});
    });
  };
  apply_with_nu(places.gain(), state, X + 1, columns);
  for (int i = 0; i < w; ++i) columns[i] = -columns[i];
  apply(places.transition(), columns, N, next_state);
  for (int i = shape.node + shape.node_sums; i < X; ++i) next_state[i] = state[i];
  apply(places.dependent(), columns, N, work + results.dependent().first);
  if (has_own_rows(shape)) {
    apply_with_nu(places.gradient(), columns, N, multipliers);
    for (int i = 0; i < n; ++i) multipliers[i] = -multipliers[i];
    solve_transposed(shape, view(record, places.factors()), multipliers);
  } else {
    apply_with_nu(places.multipliers(), state, X + 1, multipliers);
  }
}

}  // namespace DMOCBENCH_LANES
}  // namespace dmocbench::kkt
// NOLINTEND(*-avoid-c-arrays)
