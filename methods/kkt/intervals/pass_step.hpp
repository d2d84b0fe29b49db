#pragma once

#include <type_traits>

#include "methods/kkt/intervals/pass_blocks.hpp"
#include "methods/kkt/intervals/quad_products.hpp"
#include "methods/kkt/intervals/segment_kernel.hpp"

// One step of a single pass, in both directions. With s = -E z, E being the derivative of the equalities with respect
// to x_{k+1}, the next state is
//
//   x' = x + D,   z' = G (D, u),   D = J (x, u) + z + r,
//
// so only the columns of z of the cost-to-go are multiplied, and its new block of z is the Hessian of D itself.
// NOLINTBEGIN(*-identifier-naming,*-member-init,*-avoid-c-arrays,*-non-const-parameter,*-implicit-widening*): names of
// the formulas, arrays that live in registers, parameters written as vectors, offsets in one matrix
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
    return {along_inputs().end(), node_height(shape), node_height(shape)};
  }
  /// (x, u) x D: the Hessian between them.
  [[nodiscard]] constexpr BlockPlace cross() const { return {curvature().end(), input_height(shape), shape.node}; }
  /// (x, u) x z.
  [[nodiscard]] constexpr BlockPlace of_sums() const { return {cross().end(), input_height(shape), shape.node}; }
  /// (x, u) x (x, u): half of the quadratic form that D adds, not symmetric.
  [[nodiscard]] constexpr BlockPlace added() const { return {of_sums().end(), input_height(shape), input_count()}; }
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

/// Where x' is given, the terms of the Hessian that read it: no step depends on them, but they could make the pivots of
/// an interval that carries ν negative.
template <class S>
DMOCBENCH_INLINE void drop_terms_of_next(const S& shape, double* input) {
  const PassInputBlocks<S> places{shape};
  const BlockPlace rows = places.inequalities();
  for (int i = 0; i < places.mixed().end(); ++i) input[i] = 0.0;
  for (int i = 0; i < node_height(shape) * shape.node; ++i) input[places.next().first + i] = 0.0;
  for (int row = 0; row < shape.inequalities; ++row) {
    for (int i = 0; i < shape.node; ++i) input[rows(i, row)] = 0.0;
  }
}

/// Adds inequalities whose slacks are eliminated: their squares, weighted by 1/e.
template <class S>
DMOCBENCH_INLINE void add_squares(const S& shape, double* input) {
  const int n = shape.node;
  const int columns = n + free_size(shape);
  const PassInputBlocks<S> places{shape};
  const BlockPlace rows = places.inequalities();
  for (int row = 0; row < shape.inequalities; ++row) {
    const double* const of_next = input + rows(0, row);
    const double* const of_input = of_next + node_height(shape);
    const double* const value = of_input + input_height(shape);
    const double weight = 1.0 / value[1];
    for (int j = 0; j < columns + 1; ++j) {
      const double factor = weight * (j < columns ? of_input[j] : value[0]);
      for (int i = 0; i < columns; ++i) input[places.form()(i, j)] += factor * of_input[i];
    }
    for (int j = 0; j < n; ++j) {
      const double factor = weight * of_next[j];
      for (int i = 0; i < columns; ++i) input[places.mixed()(i, j)] += factor * of_input[i];
      for (int i = 0; i < n; ++i) input[places.next()(i, j)] += factor * of_next[i];
      input[places.next()(j, n)] += factor * value[0];
    }
  }
}

/// The rows of a quad after row p.
inline constexpr Quad after[4] = {{0.0, 1.0, 1.0, 1.0}, {0.0, 0.0, 1.0, 1.0}, {0.0, 0.0, 0.0, 1.0}, {}};

/// E = L U in place, with ones on the diagonal of L and reciprocals on the diagonal of U. Returns the smallest pivot
/// relative to the usual one; -1 if it is not a number.
template <class S>
DMOCBENCH_INLINE double factorise_equalities(const S& shape, const double* pivot_scales, double* E) {
  const int n = shape.node;
  const int h = node_height(shape);
  double smallest = 1e300;
  for (int p = 0; p < n; ++p) {
    double* const column = E + p * h;
    const double pivot = column[p];
    const double ratio = (pivot < 0.0 ? -pivot : pivot) * pivot_scales[p];
    smallest = ratio >= smallest ? smallest : (ratio < smallest ? ratio : -1.0);
    const double reciprocal = 1.0 / pivot;
    const int own = p / 4 * 4;
    const Quad factors = reciprocal * after[p % 4] * quad(column + own);
    for (int i = own + 4; i < h; i += 4) quad(column + i) *= reciprocal;
    for (int j = p + 1; j < n; ++j) {
      double* const other = E + j * h;
      const double factor = other[p];
      quad(other + own) -= factor * factors;
      for (int i = own + 4; i < h; i += 4) quad(other + i) -= factor * quad(column + i);
    }
    quad(column + own) = (1.0 - after[p % 4]) * quad(column + own) + factors;
    column[p] = reciprocal;
  }
  return smallest;
}

/// Solves for `count` columns of 4 `down` rows with a block of the diagonal of L, or of U. Columns of X are `height`
/// numbers apart.
template <bool is_upper, int down>
DMOCBENCH_INLINE void substitute(const double* E, int h, int count, int height, double* X) {
#pragma GCC unroll 8
  for (int step = 0; step < count; ++step) {
    const int j = is_upper ? count - 1 - step : step;
    Quad sums[down];
    for (int d = 0; d < down; ++d) sums[d] = quad(X + 4 * d + j * height);
#pragma GCC unroll 8
    for (int before = 0; before < step; ++before) {
      const int k = is_upper ? count - 1 - before : before;
      const double factor = E[j + k * h];
      for (int d = 0; d < down; ++d) sums[d] -= factor * quad(X + 4 * d + k * height);
    }
    const double scale = is_upper ? E[j + j * h] : 1.0;
    for (int d = 0; d < down; ++d) quad(X + 4 * d + j * height) = is_upper ? scale * sums[d] : sums[d];
  }
}
template <bool is_upper>
DMOCBENCH_INLINE void substitute_rows(const double* E, int h, int count, int height, double* X) {
  const int pairs = height / 8 * 8;
  for (int i = 0; i < pairs; i += 8) substitute<is_upper, 2>(E, h, count, height, X + i);
  if (pairs < height) substitute<is_upper, 1>(E, h, count, height, X + pairs);
}

/// X Eᵀ = B with the factors of E, for matrices with columns of `height` numbers.
template <class S>
DMOCBENCH_INLINE void solve_equalities(const S& shape, const double* E, int height, const double* B, double* X) {
  const int n = shape.node;
  const int h = node_height(shape);
  for (int i = 0; B != X && i < height * n; i += 4) quad(X + i) = quad(B + i);
  if constexpr (is_always_plain<S>) {
    substitute_rows<false>(E, h, n, height, X);
    substitute_rows<true>(E, h, n, height, X);
  } else {
    constexpr int most = 4;  // columns between products
    const auto solve = [&](int begin, auto is_upper) DMOCBENCH_INLINED {
      const int count = begin + most < n ? most : n - begin;
      const int known = is_upper ? begin + count : 0;
      const int depth = is_upper ? n - known : begin;
      double* const target = X + begin * height;
      carry_out_quads({height, count, depth, height, height, h, 1}, Update::subtract, target, X + known * height,
                      E + begin + known * h);
      const double* const diagonal = E + begin + begin * h;
      if (count == most) return substitute_rows<is_upper>(diagonal, h, most, height, target);
      substitute_rows<is_upper>(diagonal, h, count, height, target);
    };
    for (int begin = 0; begin < n; begin += most) solve(begin, std::false_type());
    for (int begin = (n - 1) / most * most; begin >= 0; begin -= most) solve(begin, std::true_type());
  }
}

/// E⁻¹, D and z' of the record; `next_E` has the factors of the next interval, and is null at the end, where z' is s'.
template <class S>
DMOCBENCH_INLINE void record_equalities(const S& shape, const double* input, const double* next_E,
                                        const int* places_of_rows, double* record) {
  const int n = shape.node;
  const int a = input_height(shape);
  const int h = node_height(shape);
  const PassInputBlocks<S> inputs{shape};
  const PassRecordBlocks<S> records{shape};
  const double* const E = input + inputs.equality().first;
  double* const inverse = record + records.inverse().first;
  double* const r = record + records.constant().first;
  for (int i = 0; i < h * n; i += 4) quad(inverse + i) = Quad{};
  for (int i = 0; i < n; ++i) inverse[i + places_of_rows[i] * h] = 1.0;
  solve_equalities(shape, E, h, inverse, inverse);
  solve_equalities(shape, E, a, input + inputs.inputs().first, record + records.increment().first);
  for_dots<S>(inverse, h, n, n, input + inputs.residual().first,
              [&](int i, double dot) DMOCBENCH_INLINED { r[i] = dot; });
  const double* const carry = input + inputs.carry().first;
  double* const G = record + records.sums().first;
  if (next_E != nullptr) return solve_equalities(shape, next_E, a, carry, G);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < a; i += 4) quad(G + i + j * a) = -quad(carry + i + places_of_rows[j] * a);
  }
}

/// The quadratic form of D: `curvature`, `cross` and `along_state`, `along_inputs` that they are made of.
template <class S>
DMOCBENCH_INLINE void differentiate_sums(const S& shape, const double* input, const double* G, const double* value,
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
  const double* const mixed = input + PassInputBlocks<S>{shape}.mixed().first;
  const auto along_state = [](const auto& s) {
    const int rows = input_height(s);
    return QuadSizes{rows, 2 * s.node, s.node, rows, rows, 1, state_height(s)};
  };
  const auto along_inputs = [](const auto& s) {
    const int rows = input_height(s);
    return QuadSizes{rows, s.node + free_size(s), s.node, rows, rows, rows, 1, true};
  };
  multiply<Update::set>(shape, along_state, W, G, P + n);
  multiply<Update::set>(shape, along_inputs, M, W + n * a, G);  // symmetric
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
  mirror(A, h);
}

/// The gradients of D and of (x, u), one per extra column, and what the constant r adds to γ.
template <class S, bool has_end>
DMOCBENCH_INLINE void differentiate_extras(const S& shape, const double* input, const double* record, double* value,
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
  for (int i = 0; i < n + m; ++i) of_input[i] += input[PassInputBlocks<S>{shape}.form()(i, n + m)];
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
DMOCBENCH_INLINE void condense_pass(const S& shape, const double* input, const double* J, double* value, double* work) {
  const int n = shape.node;
  const int m = free_size(shape);
  const int a = input_height(shape);
  const int b = state_height(shape);
  const int h = node_height(shape);
  const int g = whole_quads(m);
  const PassWorkBlocks<S> places{shape};
  const double* const A = work + places.curvature().first;
  double* const U = work + places.cross().first;
  const double* const W = work + places.along_state().first;
  const double* const M = work + places.along_inputs().first;
  double* const Y = work + places.of_sums().first;
  double* const K = work + places.added().first;
  double* const T = work + places.turned().first;
  const double* const form = input + PassInputBlocks<S>{shape}.form().first;
  const double* const mixed = input + PassInputBlocks<S>{shape}.mixed().first;
  multiply<Update::set>(
      shape,
      [](const auto& s) {
        const int rows = input_height(s);
        return QuadSizes{rows, s.node, s.node, rows, rows, 1, node_height(s)};
      },
      Y, J, A);
  for (int i = 0; i < a * n; i += 4) {
    const Quad of_sums = quad(Y + i);
    quad(Y + i) = quad(U + i) + of_sums;
    quad(U + i) += 0.5 * of_sums;
  }
  multiply<Update::set>(
      shape,
      [](const auto& s) {
        const int rows = input_height(s);
        return QuadSizes{rows, s.node + free_size(s), s.node, rows, rows, rows, 1};
      },
      K, U, J);
  // Half of the form, apart from `form`: x' moves with x too.
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) K[i + j * a] += mixed[i + j * a];
    for (int i = n; i < n + m; ++i) K[i + j * a] += mixed[i + j * a] + W[i + j * a];
  }
  // Rows of u.
  double* const Z = work + places.eliminated().first;
  double* const R = work + places.pivots().first;
  set_transposed(Z, b, K + n, a, m, n);
  set_transposed(Z + n, b, Y + n, a, m, n);
  set_transposed(R, g, K + n + n * a, a, m, m);
  for (int j = 0; j < m; ++j) {
    const int column = (n + j) * a;
    for (int i = 0; i < n; ++i) Z[i + j * b] += form[i + column] + K[i + column];
    for (int i = 2 * n; i < b; ++i) Z[i + j * b] = 0.0;
    for (int i = 0; i < m; ++i) R[i + j * g] += form[n + i + column] + M[n + i + column] + K[n + i + column];
    for (int i = m; i < g; ++i) R[i + j * g] = 0.0;
  }
  // The others, of which the lower triangle counts.
  double* const P = value;
  set_transposed(T, h, K, a, n, n);
  set_transposed(P + n, b, Y, a, n, n);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) P[i + j * b] += form[i + j * a] + K[i + j * a] + T[i + j * h];
    for (int i = 0; i < n; ++i) P[n + i + (n + j) * b] = A[i + j * h];
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
    for (int i = 0; i < b; i += 4) {
      Quad sum = quad(Z + i + p * b);
      for (int q = 0; q < p; ++q) sum -= L[p + q * g] * quad(Z + i + q * b);
      quad(Z + i + p * b) = sum;
    }
    for (int j = 0; j < extra; ++j) {
      for (int q = 0; q < p; ++q) offset[p + j * g] -= L[p + q * g] * offset[q + j * g];
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
DMOCBENCH_INLINE void pass_backward(const S& shape, const double* input, double* record, double* end_record,
                                    double* value, double* work, PassSigns& signs) {
  const int n = shape.node;
  const int b = state_height(shape);
  const BlockPlace next = PassInputBlocks<S>{shape}.next();
  const PassRecordBlocks<S> records{shape};
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) value[i + j * b] += input[next(i, j)];
  }
  double* const p = value + PassValueBlocks<S>{shape}.extras().first;
  for (int i = 0; i < n; ++i) p[i] += input[next(i, n)];
  differentiate_sums(shape, input, record + records.sums().first, value, work);
  differentiate_extras<S, has_end>(shape, input, record, value, work);
  condense_pass<S, has_end>(shape, input, record + records.increment().first, value, work);
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
  const double* const inverse = record + records.inverse().first;
  for (int i = 0; i < h; i += 4) {
    Quad sum{};
    for (int j = 0; j < n; ++j) sum -= costate[j] * quad(inverse + i + j * h);
    quad(multipliers + i) = sum;
  }
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
// NOLINTEND(*-identifier-naming,*-member-init,*-avoid-c-arrays,*-non-const-parameter,*-implicit-widening*)
