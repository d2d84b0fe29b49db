#pragma once

#include "methods/kkt/intervals/pass_blocks.hpp"
#include "methods/kkt/intervals/quad_products.hpp"
#include "methods/kkt/intervals/segment_kernel.hpp"

// One step of a single pass, in both directions. With s = -E z, E being the derivative of the equalities with respect
// to x_{k+1}, the next state is
//
//   x' = x + D,   z' = G (D, u),   D = J (x, u) + z + r,
//
// so only the columns of z of the cost-to-go are multiplied, and its new block of z is the Hessian of D itself.
// NOLINTBEGIN(*-identifier-naming,*-member-init): names of the formulas
namespace dmocbench::kkt {
inline namespace DMOCBENCH_LANES {

/// Work of one step backward. `extras`: columns (1, ν).
template <class S>
struct PassWorkBlocks {
  S shape;
  [[nodiscard]] constexpr int extra_count() const { return 1 + 2 * shape.node; }
  [[nodiscard]] constexpr int input_count() const { return shape.node + free_size(shape); }
  /// (D, u) x (X, extras): derivatives of the cost of z' along X.
  [[nodiscard]] constexpr BlockPlace along_state() const {
    return {0, input_height(shape), 2 * shape.node + extra_count()};
  }
  /// (D, u) x (D, u): the quadratic form of z'.
  [[nodiscard]] constexpr BlockPlace along_inputs() const {
    return {along_state().end(), input_height(shape), input_count()};
  }
  /// D x D: the Hessian of D.
  [[nodiscard]] constexpr BlockPlace curvature() const {
    return {along_inputs().end(), node_height(shape), shape.node};
  }
  /// (x, u) x D: the Hessian between them.
  [[nodiscard]] constexpr BlockPlace cross() const { return {curvature().end(), input_height(shape), shape.node}; }
  /// (x, u) x z.
  [[nodiscard]] constexpr BlockPlace of_sums() const { return {cross().end(), input_height(shape), shape.node}; }
  /// cross + ½ Jᵀ curvature.
  [[nodiscard]] constexpr BlockPlace half() const { return {of_sums().end(), input_height(shape), shape.node}; }
  /// (x, u) x (x, u): half of the quadratic form that D adds, not symmetric.
  [[nodiscard]] constexpr BlockPlace added() const { return {half().end(), input_height(shape), input_count()}; }
  /// D x extras and (x, u) x extras: gradients.
  [[nodiscard]] constexpr BlockPlace along_increment() const {
    return {added().end(), node_height(shape), extra_count()};
  }
  [[nodiscard]] constexpr BlockPlace gradient() const {
    return {along_increment().end(), input_height(shape), extra_count()};
  }
  /// X x u, u x u, and u x extras twice: the form's rows of u; eliminated, and divided by the pivots.
  [[nodiscard]] constexpr BlockPlace eliminated() const {
    return {gradient().end(), state_height(shape), free_size(shape)};
  }
  [[nodiscard]] constexpr BlockPlace pivots() const {
    return {eliminated().end(), whole_quads(free_size(shape)), free_size(shape)};
  }
  [[nodiscard]] constexpr BlockPlace offset() const {
    return {pivots().end(), whole_quads(free_size(shape)), extra_count()};
  }
  [[nodiscard]] constexpr BlockPlace divided() const {
    return {offset().end(), whole_quads(free_size(shape)), extra_count()};
  }
  /// Transposed blocks.
  [[nodiscard]] constexpr BlockPlace turned() const {
    return {divided().end(), whole_quads(input_count()), whole_quads(input_count())};
  }
  [[nodiscard]] constexpr int size() const { return turned().end(); }
};

/// to(j, i) = from(i, j), for rows x columns entries.
DMOCBENCH_INLINE void set_transposed(double* to, int to_height, const double* from, int from_height, int rows,
                                     int columns) {
  if (rows % 4 == 0 && columns % 4 == 0 && to_height % 4 == 0) {
    for (int j = 0; j < columns; j += 4) {
      for (int i = 0; i < rows; i += 4) {
        Quad block[4];
        for (int c = 0; c < 4; ++c) __builtin_memcpy(&block[c], from + i + (j + c) * from_height, sizeof(Quad));
        transpose(block);
        for (int c = 0; c < 4; ++c) quad(to + j + (i + c) * to_height) = block[c];
      }
    }
    return;
  }
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < rows; ++i) to[j + i * to_height] = from[i + j * from_height];
  }
}

/// The signs of the pivots of a pass.
struct PassSigns {
  bool hold = true;          ///< all are positive, beyond rounding
  bool is_negative = false;  ///< one is negative, beyond doubt
  void note(double pivot, double diagonal) {
    const double size = diagonal < 0.0 ? -diagonal : diagonal;
    if (pivot > smallest_pivot_share * size) return;
    hold = false;
    is_negative = is_negative || pivot < -certain_pivot_share * size;
  }
};

/// The quadratic form of D: `curvature`, `cross` and `along_state`, `along_inputs` that they are made of.
template <class S>
DMOCBENCH_INLINE void differentiate_sums(const S& shape, const double* cost, const double* G, const double* value,
                                         double* work) {
  const int n = shape.node;
  const int m = free_size(shape);
  const int a = input_height(shape);
  const int b = state_height(shape);
  const PassWorkBlocks<S> places{shape};
  const double* const P = value;
  double* const W = work + places.along_state().first;
  double* const M = work + places.along_inputs().first;
  double* const A = work + places.curvature().first;
  double* const U = work + places.cross().first;
  double* const T = work + places.turned().first;
  const double* const mixed = cost + PassCostBlocks<S>{shape}.mixed().first;
  const auto along_state = [](const auto& s) {
    const int rows = input_height(s);
    return QuadSizes{rows, 2 * s.node, s.node, rows, rows, 1, state_height(s)};
  };
  const auto along_inputs = [](const auto& s) {
    const int rows = input_height(s);
    return QuadSizes{rows, s.node + free_size(s), s.node, rows, rows, rows, 1};
  };
  multiply<Update::set>(shape, along_state, W, G, P + n);
  multiply<Update::set>(shape, along_inputs, M, W + n * a, G);
  const int h = node_height(shape);
  set_transposed(T, h, W, a, n, n);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double of_node = P[i + j * b] + T[i + j * h];
      A[i + j * h] = M[i + j * a] + W[i + j * a] + of_node;
      U[i + j * a] = of_node + mixed[i + j * a];
    }
    for (int i = n; i < n + m; ++i) U[i + j * a] = M[i + j * a] + W[i + j * a] + mixed[i + j * a];
    for (int i = n + m; i < a; ++i) U[i + j * a] = 0.0;
  }
}

/// The gradients of D and of (x, u), one per extra column, and what the constant r adds to γ.
template <class S, bool has_end>
DMOCBENCH_INLINE void differentiate_extras(const S& shape, const double* cost, const double* record, double* value,
                                           double* work) {
  const int n = shape.node;
  const int m = free_size(shape);
  const int a = input_height(shape);
  const int b = state_height(shape);
  const int h = node_height(shape);
  const int extra = has_end ? 1 + 2 * n : 1;
  const PassWorkBlocks<S> places{shape};
  const PassRecordBlocks<S> records{shape};
  const double* const r = record + records.constant().first;
  const double* const J = record + records.increment().first;
  const double* const old = value + PassValueBlocks<S>{shape}.extras().first;
  const double* const A = work + places.curvature().first;
  const double* const U = work + places.cross().first;
  const double* const W = work + places.along_state()(0, 2 * n);
  double* const of_D = work + places.along_increment().first;
  double* const of_input = work + places.gradient().first;
  multiply<Update::set>(
      shape,
      [](const auto& s) {
        const int rows = input_height(s);
        return QuadSizes{rows, has_end ? 1 + 2 * s.node : 1, s.node, rows, rows, 1, state_height(s)};
      },
      work + places.along_state()(0, 2 * n), record + records.sums().first, old + n);
  for (int j = 0; j < extra; ++j) {
    for (int i = 0; i < n; ++i) {
      of_D[i + j * h] = W[i + j * a] + old[i + j * b];
      of_input[i + j * a] = old[i + j * b];
    }
    for (int i = n; i < n + m; ++i) of_input[i + j * a] = W[i + j * a];
    for (int i = n + m; i < a; ++i) of_input[i + j * a] = 0.0;
  }
  for (int i = 0; i < n + m; ++i) of_input[i] += cost[PassCostBlocks<S>{shape}.form()(i, n + m)];
  double* const gamma = value + PassValueBlocks<S>{shape}.reachability().first;
  for (int j = 1; j < extra; ++j) {
    for (int i = 0; i < n; ++i) gamma[j - 1] += of_D[i + j * h] * r[i];
  }
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < n; ++i) of_D[i] += A[i + k * h] * r[k];
  }
  multiply<Update::add>(
      shape,
      [](const auto& s) {
        const int rows = input_height(s);
        return QuadSizes{rows, 1, s.node, rows, rows, 1, node_height(s)};
      },
      of_input, U, r);
  multiply<Update::add>(
      shape,
      [](const auto& s) {
        const int rows = input_height(s);
        return QuadSizes{rows, has_end ? 1 + 2 * s.node : 1, s.node, rows, rows, 1, node_height(s)};
      },
      of_input, J, of_D);
}

/// The quadratic form in (u, X): the rows of u go to the work, the others replace the cost-to-go.
template <class S, bool has_end>
DMOCBENCH_INLINE void condense_pass(const S& shape, const double* cost, const double* J, double* value, double* work) {
  const int n = shape.node;
  const int m = free_size(shape);
  const int a = input_height(shape);
  const int b = state_height(shape);
  const int h = node_height(shape);
  const int g = whole_quads(m);
  const PassWorkBlocks<S> places{shape};
  const double* const A = work + places.curvature().first;
  const double* const U = work + places.cross().first;
  const double* const W = work + places.along_state().first;
  const double* const M = work + places.along_inputs().first;
  double* const Y = work + places.of_sums().first;
  double* const half = work + places.half().first;
  double* const K = work + places.added().first;
  double* const T = work + places.turned().first;
  const double* const form = cost + PassCostBlocks<S>{shape}.form().first;
  multiply<Update::set>(
      shape,
      [](const auto& s) {
        const int rows = input_height(s);
        return QuadSizes{rows, s.node, s.node, rows, rows, 1, node_height(s)};
      },
      Y, J, A);
  for (int i = 0; i < a * n; i += 4) {
    quad(half + i) = quad(U + i) + 0.5 * quad(Y + i);
    quad(Y + i) += quad(U + i);
  }
  multiply<Update::set>(
      shape,
      [](const auto& s) {
        const int rows = input_height(s);
        return QuadSizes{rows, s.node + free_size(s), s.node, rows, rows, rows, 1};
      },
      K, half, J);
  // Rows of u.
  double* const Z = work + places.eliminated().first;
  double* const R = work + places.pivots().first;
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      Z[i + j * b] = form[i + (n + j) * a] + K[i + (n + j) * a] + W[n + j + i * a] + K[n + j + i * a];
      Z[n + i + j * b] = Y[n + j + i * a];
    }
    for (int i = 2 * n; i < b; ++i) Z[i + j * b] = 0.0;
    for (int i = 0; i < m; ++i) {
      const int at = n + i + (n + j) * a;
      R[i + j * g] = form[at] + M[at] + K[at] + K[n + j + (n + i) * a];
    }
    for (int i = m; i < g; ++i) R[i + j * g] = 0.0;
  }
  // The others.
  double* const P = value;
  set_transposed(T, h, K, a, n, n);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) P[i + j * b] += form[i + j * a] + K[i + j * a] + T[i + j * h];
  }
  set_transposed(T, h, Y, a, n, n);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      P[n + i + j * b] = T[i + j * h];
      P[i + (n + j) * b] = Y[i + j * a];
      P[n + i + (n + j) * b] = A[i + j * h];
    }
  }
  const double* const of_D = work + places.along_increment().first;
  const double* const of_input = work + places.gradient().first;
  double* const extras = value + PassValueBlocks<S>{shape}.extras().first;
  double* const offset = work + places.offset().first;
  for (int j = 0; j < (has_end ? 1 + 2 * n : 1); ++j) {
    for (int i = 0; i < n; ++i) {
      extras[i + j * b] = of_input[i + j * a];
      extras[n + i + j * b] = of_D[i + j * h];
    }
    for (int i = 0; i < m; ++i) offset[i + j * g] = of_input[n + i + j * a];
    for (int i = m; i < g; ++i) offset[i + j * g] = 0.0;
  }
}

/// Factors L of the Hessian of u; the rows of u are eliminated one by one.
template <class S, bool has_end>
DMOCBENCH_INLINE void factorise_inputs(const S& shape, double* record, double* end_record, double* work,
                                       PassSigns& signs) {
  const int m = free_size(shape);
  const int b = state_height(shape);
  const int g = whole_quads(m);
  const int extra = has_end ? 1 + 2 * shape.node : 1;
  const PassWorkBlocks<S> places{shape};
  const PassRecordBlocks<S> records{shape};
  double* const R = work + places.pivots().first;
  double* const Z = work + places.eliminated().first;
  double* const offset = work + places.offset().first;
  double* const divided = work + places.divided().first;
  double* const L = record + records.factor().first;
  double* const gain = record + records.gain().first;
  double* const diagonal = work + places.turned().first;
  for (int p = 0; p < m; ++p) diagonal[p] = R[p + p * g];
  for (int p = 0; p < m; ++p) {
    for (int q = 0; q < p; ++q) {
      const double factor = L[p + q * g];
      for (int i = 0; i < b; i += 4) quad(Z + i + p * b) -= factor * quad(Z + i + q * b);
      for (int j = 0; j < extra; ++j) offset[p + j * g] -= factor * offset[q + j * g];
    }
    signs.note(R[p + p * g], diagonal[p]);
    const double reciprocal = 1.0 / R[p + p * g];
    for (int i = 0; i < g; i += 4) quad(L + i + p * g) = reciprocal * quad(R + i + p * g);
    for (int j = p + 1; j < m; ++j) {
      const double factor = L[j + p * g];
      for (int i = 0; i < g; i += 4) quad(R + i + j * g) -= factor * quad(R + i + p * g);
    }
    for (int i = 0; i < b; i += 4) quad(gain + i + p * b) = reciprocal * quad(Z + i + p * b);
    for (int j = 0; j < extra; ++j) divided[p + j * g] = reciprocal * offset[p + j * g];
  }
  for (int i = 0; i < g; i += 4) quad(record + records.offset().first + i) = quad(divided + i);
  if constexpr (has_end) {
    for (int i = 0; i < g * 2 * shape.node; i += 4) quad(end_record + i) = quad(divided + g + i);
  }
}

/// The cost-to-go with this interval in front.
template <class S, bool has_end>
DMOCBENCH_INLINE void advance_pass(const S& shape, double* record, double* end_record, double* value, double* work) {
  const int n = shape.node;
  const int m = free_size(shape);
  const int b = state_height(shape);
  const int h = node_height(shape);
  const int g = whole_quads(m);
  const PassWorkBlocks<S> places{shape};
  const PassRecordBlocks<S> records{shape};
  const PassValueBlocks<S> values{shape};
  const double* const Z = work + places.eliminated().first;
  multiply<Update::subtract>(
      shape,
      [](const auto& s) {
        const int rows = state_height(s);
        return QuadSizes{rows, 2 * s.node, free_size(s), rows, rows, rows, 1, true};
      },
      value, Z, record + records.gain().first);
  mirror(value, b);
  double* const extras = value + values.extras().first;
  const double* const divided = work + places.divided().first;
  multiply<Update::subtract>(
      shape,
      [](const auto& s) {
        const int rows = state_height(s);
        return QuadSizes{rows, has_end ? 1 + 2 * s.node : 1, free_size(s), rows, rows, 1, whole_quads(free_size(s))};
      },
      extras, Z, divided);
  double* const costate = record + records.costate().first;
  for (int i = 0; i < b * n; ++i) costate[i] = value[b * n + i];
  for (int i = 0; i < n; ++i) record[records.costate_offset().first + i] = extras[n + i];
  if constexpr (has_end) {
    const double* const offset = work + places.offset().first;
    const int X = 2 * n;
    double* const gamma = value + values.reachability().first;
    double* const Gamma = gamma + X;
    double* const of_nu = end_record + PassEndBlocks<S>{shape}.costate_offset().first;
    for (int j = 0; j < X; ++j) {
      for (int p = 0; p < m; ++p) gamma[j] -= offset[p] * divided[p + (1 + j) * g];
      for (int i = 0; i < n; ++i) of_nu[i + j * h] = extras[n + i + (1 + j) * b];
      for (int i = j; i < X; ++i) {
        double sum = 0.0;
        for (int p = 0; p < m; ++p) sum += offset[p + (1 + i) * g] * divided[p + (1 + j) * g];
        Gamma[i + j * X] += sum;
      }
    }
  }
}

/// Eliminates an interval in front of the cost-to-go.
template <class S, bool has_end>
DMOCBENCH_INLINE void pass_backward(const S& shape, const double* cost, double* record, double* end_record,
                                    double* value, double* work, PassSigns& signs) {
  const int n = shape.node;
  const int b = state_height(shape);
  const BlockPlace next = PassCostBlocks<S>{shape}.next();
  const PassRecordBlocks<S> records{shape};
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) value[i + j * b] += cost[next(i, j)];
  }
  double* const p = value + PassValueBlocks<S>{shape}.extras().first;
  for (int i = 0; i < n; ++i) p[i] += cost[next(i, n)];
  differentiate_sums(shape, cost, record + records.sums().first, value, work);
  differentiate_extras<S, has_end>(shape, cost, record, value, work);
  condense_pass<S, has_end>(shape, cost, record + records.increment().first, value, work);
  factorise_inputs<S, has_end>(shape, record, end_record, work, signs);
  advance_pass<S, has_end>(shape, record, end_record, value, work);
}

/// u, multipliers and the next state from the state; `nu` is null where the interval does not carry it.
template <class S>
DMOCBENCH_INLINE void pass_forward(const S& shape, const double* record, const double* end_record, const double* nu,
                                   double* work) {
  const int n = shape.node;
  const int m = free_size(shape);
  const int a = input_height(shape);
  const int b = state_height(shape);
  const int h = node_height(shape);
  const int g = whole_quads(m);
  const PassRecordBlocks<S> records{shape};
  const PassForwardBlocks<S> places{shape};
  const PassEndBlocks<S> ends{shape};
  double* const X = work;
  double* const inputs = work + places.inputs().first;
  double* const u = inputs + n;
  double* const costate = work + places.costate().first;
  const double* const offset = record + records.offset().first;
  const double* const costate_offset = record + records.costate_offset().first;
  for_dots<S>(record + records.gain().first, b, 2 * n, m, X,
              [&](int p, double dot) DMOCBENCH_INLINED { u[p] = dot + offset[p]; });
  for_dots<S>(record + records.costate().first, b, 2 * n, n, X,
              [&](int i, double dot) DMOCBENCH_INLINED { costate[i] = dot + costate_offset[i]; });
  if (nu != nullptr) {
    for (int j = 0; j < 2 * n; ++j) {
      for (int p = 0; p < m; ++p) u[p] += end_record[ends.offset()(p, j)] * nu[j];
      for (int i = 0; i < n; ++i) costate[i] += end_record[ends.costate_offset()(i, j)] * nu[j];
    }
  }
  const double* const L = record + records.factor().first;
  for (int p = m - 1; p >= 0; --p) {
    u[p] = -u[p];
    for (int q = p + 1; q < m; ++q) u[p] -= L[q + p * g] * u[q];
  }
  double* const multipliers = work + places.multipliers().first;
  for_dots<S>(record + records.inverse().first, h, n, n, costate,
              [&](int i, double dot) DMOCBENCH_INLINED { multipliers[i] = -dot; });
  for (int i = 0; i < n; ++i) inputs[i] = X[i];
  double* const D = costate;  // no longer needed
  const double* const r = record + records.constant().first;
  for_dots<S>(record + records.increment().first, a, n + m, n, inputs,
              [&](int i, double dot) DMOCBENCH_INLINED { D[i] = dot + X[n + i] + r[i]; });
  for (int i = 0; i < n; ++i) {
    X[i] += D[i];
    inputs[i] = D[i];
  }
  for_dots<S>(record + records.sums().first, a, n + m, n, inputs,
              [&](int i, double dot) DMOCBENCH_INLINED { X[n + i] = dot; });
}

}  // namespace DMOCBENCH_LANES
}  // namespace dmocbench::kkt
// NOLINTEND(*-identifier-naming,*-member-init)
