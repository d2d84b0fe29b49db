#pragma once

#include "methods/kkt/intervals/kernel_blocks.hpp"

// One step of both sweeps for a plain shape whose sizes are known at compile time, by the formulas of README.md. All
// loops are unrolled, and their operands can live in registers.
namespace dmocbench::kkt {
inline namespace DMOCBENCH_LANES {

/// Solves the equalities for the dependent entries of Z. Rows and columns come in an order in which no exchange is
/// needed, see elimination_plan.hpp.
template <class S>
DMOCBENCH_INLINE void eliminate_equalities(const LocalSystem<S>& local, CostToGo<S>& V, StepWork<S>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  const int columns = Z + X + 1;
  auto& E = work.equalities;
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < n; ++i) E(i, j) = local.equality(i, j);
  }
  for (int i = 0; i < local.shape.node; ++i) {
    if (!local.moves_by_increment(i)) continue;
    for (int row = 0; row < n; ++row) E(row, Z + i) += E(row, local.next_of_node(i));
  }
  for (int p = 0; p < n; ++p) {
    const Lanes pivot = E(p, p);
    V.smallest_ratio = least_so_far(V.smallest_ratio, magnitude(pivot) * Lanes::all(local.pivot_scales[p]));
    work.reciprocals(p) = Lanes::all(1.0) / pivot;
    for (int i = p + 1; i < n; ++i) {
      const Lanes factor = E(i, p) * work.reciprocals(p);
      E(i, p) = factor;
      for (int j = p + 1; j < columns; ++j) E(i, j) -= factor * E(p, j);
    }
  }
  for (int j = n; j < columns; ++j) {
    for (int p = n - 1; p >= 0; --p) {
      Lanes sum = E(p, j);
      for (int q = p + 1; q < n; ++q) sum -= E(p, q) * E(q, j);
      E(p, j) = sum * work.reciprocals(p);
    }
  }
}

/// The contributions to the rows of the next node, column j. The dependent entries in the work are still increments.
template <class S>
DMOCBENCH_INLINE void sum_at_next_node(const LocalSystem<S>& local, int j, StepWork<S>& work) {
  const S& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  for (int row = 0; row < shape.node_sums; ++row) {
    Lanes sum = j < w ? local.carry(row, shape.node + n + j) : Lanes{};
    for (int i = 0; i < shape.node; ++i) {
      if (local.moves_by_increment(i)) {
        sum -= local.carry(row, i) * work.dependent(local.next_of_node(i), j);
      } else if (j == w + i) {
        sum += local.carry(row, i);
      }
    }
    work.transition(shape.node + row, j) = sum;
  }
}

/// Z and the next state as linear functions of (w, X, 1).
template <class S>
DMOCBENCH_INLINE void make_transition(const LocalSystem<S>& local, StepWork<S>& work, Lanes* /*record*/) {
  const S& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  const Lanes zero{};
  const Lanes one = Lanes::all(1.0);
  for (int j = 0; j < N; ++j) {
    for (int i = 0; i < n; ++i) work.dependent(i, j) = -work.equalities(i, n + j);
    sum_at_next_node(local, j, work);
    for (int i = 0; i < shape.node; ++i) {
      if (j == w + i && local.moves_by_increment(i)) work.dependent(local.next_of_node(i), j) += one;
    }
    for (int i = shape.node + shape.node_sums; i < X; ++i) work.transition(i, j) = j == w + i ? one : zero;
  }
}

/// Derivatives of the interval's cost with respect to Z, and of the cost-to-go with respect to the next state, as
/// functions of (w, X, 1).
template <class S>
DMOCBENCH_INLINE void differentiate_interval(const LocalSystem<S>& local, CostToGo<S>& V, StepWork<S>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  const auto& H = local.hessian;
  const auto direct = [&](int i, int j) { return H(i, j < w ? n + j : Z + j - w); };
  for (int j = 0; j < N; ++j) {
    for (int i = n; i < Z; ++i) {
      Lanes sum = direct(i, j);
      for (int z = 0; z < n; ++z) sum += H(i, z) * work.dependent(z, j);
      work.gradient(i, j) = sum;
    }
    const bool is_constant = j == N - 1;
    for (int i = 0; i < X; ++i) {
      Lanes sum = is_constant ? V.p(i) : Lanes{};
      if (i < n) sum += direct(i, j);
      for (int x = 0; x < X; ++x) {
        const Lanes curvature = i < n && x < n ? V.P(i, x) + H(i, x) : V.P(i, x);
        sum += curvature * work.transition(x, j);
      }
      work.costate(i, j) = sum;
    }
  }
}

/// An inequality as a function of (w, X, 1), weighted by 1/e.
template <class S>
DMOCBENCH_INLINE void weigh_inequality(const LocalSystem<S>& local, int row, StepWork<S>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  const auto& C = local.inequality;
  const Lanes weight = Lanes::all(1.0) / local.compliance(row);
  for (int j = 0; j < N; ++j) {
    Lanes sum = j < w ? C(row, n + j) : C(row, Z + j - w);
    for (int z = 0; z < n; ++z) sum += C(row, z) * work.dependent(z, j);
    work.line(j) = weight * sum;
  }
}

/// An inequality whose slack is eliminated adds its square, weighted by 1/e, to the quadratic form. This adds the
/// derivative of the square with respect to Z.
template <class S>
DMOCBENCH_INLINE void add_inequality(const LocalSystem<S>& local, int row, StepWork<S>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  weigh_inequality(local, row, work);
  for (int j = 0; j < N; ++j) {
    for (int z = 0; z < Z; ++z) {
      Lanes& derivative = z < n ? work.costate(z, j) : work.gradient(z, j);
      derivative += local.inequality(row, z) * work.line(j);
    }
  }
}

/// The part of the same square that reads X directly.
template <class S>
DMOCBENCH_INLINE void add_direct_inequality(const LocalSystem<S>& local, int row, StepWork<S>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  weigh_inequality(local, row, work);
  for (int x = 0; x < X; ++x) {
    const Lanes derivative = local.inequality(row, Z + x);
    for (int i = w + x; i < N; ++i) work.condensed(i, w + x) += derivative * work.line(i);
  }
}

/// The quadratic form of the interval and of the cost-to-go, in (w, X, 1).
template <class S>
DMOCBENCH_INLINE void condense(const LocalSystem<S>& local, const Lanes::Mask* /*active*/, CostToGo<S>& V,
                               StepWork<S>& work) {
  const auto [n, Z, X, w, N] = sizes_of(local.shape);
  const auto& A = work.transition;
  differentiate_interval(local, V, work);
  for (int row = 0; row < local.shape.inequalities; ++row) add_inequality(local, row, work);
  for (int j = 0; j < w + X; ++j) {
    for (int i = j; i < N; ++i) {
      Lanes sum{};
      for (int x = 0; x < X; ++x) sum += A(x, j) * work.costate(x, i);
      if (j < w) {
        sum += work.gradient(n + j, i);
      } else {
        for (int z = 0; z < n; ++z) sum += local.hessian(z, Z + j - w) * work.dependent(z, i);
      }
      work.condensed(i, j) = sum;
    }
  }
  for (int row = 0; row < local.shape.inequalities; ++row) add_direct_inequality(local, row, work);
  for (int j = 0; j < X; ++j) {
    for (int i = 0; i < N; ++i) {
      Lanes sum{};
      for (int x = 0; x < X; ++x) sum += A(x, i) * V.Phi(x, j);
      work.last_state(i, j) = sum;
    }
  }
}

/// Factors L D Lᵀ of the free unknowns' Hessian: the eliminated rows stay in `condensed` and `last_state`, the same
/// divided by the pivots goes to `scaled`.
template <class S>
DMOCBENCH_INLINE void factorise_free(const S& shape, CostToGo<S>& V, StepWork<S>& work) {
  const auto [n, Z, X, w, N] = sizes_of(shape);
  auto& C = work.condensed;
  auto& scaled = work.scaled;
  for (int p = 0; p < w; ++p) {
    const Lanes diagonal = C(p, p);
    for (int q = 0; q < p; ++q) {
      for (int i = p; i < N; ++i) C(i, p) -= C(i, q) * scaled(q, p);
      for (int j = 0; j < X; ++j) work.last_state(p, j) -= scaled(q, p) * work.last_state(q, j);
    }
    const Lanes reciprocal = Lanes::all(1.0) / V.signs.note(C(p, p), diagonal);
    for (int i = p + 1; i < N; ++i) scaled(p, i) = C(i, p) * reciprocal;
    for (int j = 0; j < X; ++j) scaled(p, N + j) = work.last_state(p, j) * reciprocal;
  }
}

/// The cost-to-go with this interval in front; `put(target, value)` sets an entry of it.
template <class S, class Put>
DMOCBENCH_INLINE void advance_by(const Put& put, const S& shape, const StepWork<S>& work, CostToGo<S>& V) {
  const auto [n, Z, X, w, N] = sizes_of(shape);
  const auto& C = work.condensed;
  const auto& scaled = work.scaled;
  for (int j = 0; j < X; ++j) {
    for (int i = j; i < X + 1; ++i) {
      Lanes sum = C(w + i, w + j);
      for (int q = 0; q < w; ++q) sum -= C(w + i, q) * scaled(q, w + j);
      if (i == X) {
        put(V.p(j), sum);
      } else {
        put(V.P(i, j), sum);
        put(V.P(j, i), sum);
      }
    }
    for (int i = 0; i < X + 1; ++i) {
      Lanes sum = work.last_state(w + i, j);
      for (int q = 0; q < w; ++q) sum -= C(w + i, q) * scaled(q, N + j);
      if (i < X) {
        put(V.Phi(i, j), sum);
      } else {
        put(V.gamma(j), V.gamma(j) + sum);
      }
    }
    for (int i = j; i < X; ++i) {
      Lanes sum = V.Gamma(i, j);
      for (int q = 0; q < w; ++q) sum += work.last_state(q, i) * scaled(q, N + j);
      put(V.Gamma(i, j), sum);
    }
  }
}

/// The same of the active lanes.
template <class S>
DMOCBENCH_INLINE void advance(const S& shape, const Lanes::Mask* active, const StepWork<S>& work, CostToGo<S>& V) {
  if (active == nullptr) return advance_by([](Lanes& target, const Lanes& value) { target = value; }, shape, work, V);
  advance_by([&](Lanes& target, const Lanes& value) { target = chosen(*active, value, target); }, shape, work, V);
}

/// w = -(gain)(X, 1, ν): L⁻ᵀ applied to the result of `factorise_free`.
template <class S>
DMOCBENCH_INLINE void store_gain(const S& shape, const StepWork<S>& work, const MatrixView<Lanes>& gain) {
  const int w = free_size(shape);
  for (int j = 0; j < 2 * state_size(shape) + 1; ++j) {
    for (int p = w - 1; p >= 0; --p) {
      Lanes sum = work.scaled(p, w + j);
      for (int q = p + 1; q < w; ++q) sum -= work.scaled(p, q) * gain(q, j);
      gain(p, j) = sum;
    }
  }
}

template <class S>
DMOCBENCH_INLINE void store_transition(const S& shape, const StepWork<S>& work, Lanes* record) {
  copy_columns(work.transition, column_count(shape), view(record, RecordBlocks<S>{shape}.transition()));
}

/// The gradient that the multipliers of the interval's equalities balance; before `advance`.
template <class S>
DMOCBENCH_INLINE void store_gradient(const LocalSystem<S>& local, CostToGo<S>& V, const StepWork<S>& work,
                                     const MatrixView<Lanes>& gradient) {
  const S& shape = local.shape;
  const auto [n, Z, X, w, N] = sizes_of(shape);
  const auto add_cost_to_go = [&](const Lanes* costate, Lanes* column) {
    for (int i = 0; i < shape.node; ++i) {
      const int z = local.next_of_node(i);
      if (z < n) column[z] += costate[i];
    }
    for (int i = 0; i < shape.node_sums; ++i) {
      for (int x = 0; x < shape.node; ++x) {
        if (local.moves_by_increment(x)) column[local.next_of_node(x)] -= local.carry(i, x) * costate[shape.node + i];
      }
    }
  };
  for (int j = 0; j < N; ++j) {
    for (int z = 0; z < n; ++z) gradient(z, j) = Lanes{};
    add_cost_to_go(&work.costate(0, j), &gradient(0, j));
  }
  for (int j = 0; j < X; ++j) {
    for (int z = 0; z < n; ++z) gradient(z, N + j) = Lanes{};
    add_cost_to_go(&V.Phi(0, j), &gradient(0, N + j));
  }
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
  const auto times_state = [&](const MatrixView<const Lanes>& matrix, int i) {  // (X, 1, ν)
    Lanes sum{};
    for (int j = 0; j <= X; ++j) sum += matrix(i, j) * state[j];
    for (int j = 0; j < X; ++j) sum += matrix(i, X + 1 + j) * nu[j];
    return sum;
  };
  for (int i = 0; i < w; ++i) columns[i] = -times_state(view(record, places.gain()), i);
  const auto apply = [&](const MatrixView<const Lanes>& matrix, Lanes* result) {
    for (int i = 0; i < matrix.rows; ++i) {
      Lanes sum{};
      for (int j = 0; j < N; ++j) sum += matrix(i, j) * columns[j];
      result[i] = sum;
    }
  };
  apply(view(record, places.transition()), next_state);
  for (int i = shape.node + shape.node_sums; i < X; ++i) next_state[i] = state[i];
  if (has_own_rows(shape)) {
    const auto gradient = view(record, places.gradient());
    apply(gradient, multipliers);
    for (int i = 0; i < n; ++i) {
      Lanes sum = multipliers[i];
      for (int j = 0; j < X; ++j) sum += gradient(i, N + j) * nu[j];
      multipliers[i] = -sum;
    }
    solve_transposed(shape, view(record, places.factors()), multipliers);
  } else {
    for (int i = 0; i < shape.node_sums; ++i) multipliers[i] = times_state(view(record, places.multipliers()), i);
  }
}

}  // namespace DMOCBENCH_LANES
}  // namespace dmocbench::kkt
