#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "methods/kkt/intervals/kernel_blocks.hpp"

// Products of matrices of one interval, whose columns fill vectors of four numbers: every column begins at a multiple
// of four, and the rows after the last one are zero.
// NOLINTBEGIN(*-avoid-c-arrays,*-reinterpret-cast,*-member-init,*-non-const-parameter,*-implicit-widening*): arrays
// that live in registers, numbers written as vectors, offsets in one matrix
namespace dmocbench::kkt {
inline namespace DMOCBENCH_LANES {

using Quad = double __attribute__((vector_size(4 * sizeof(double))));

DMOCBENCH_INLINE Quad& quad(double* numbers) { return *reinterpret_cast<Quad*>(numbers); }
DMOCBENCH_INLINE const Quad& quad(const double* numbers) { return *reinterpret_cast<const Quad*>(numbers); }

/// The number of unknowns of a node if it is known at compile time, else more than any.
template <class S>
inline constexpr int known_nodes = 1 << 20;
template <int node, int... sizes>
inline constexpr int known_nodes<FixedShape<node, sizes...>> = node;

enum class Update : unsigned char { set, add, subtract };

/// Sizes of a product C = A B, and where entries stand: A and C column by column, columns of A `left` and columns of C
/// `result` numbers apart; entry (k, j) of B is at k * down + j * right.
struct QuadSizes {
  int rows;  ///< a multiple of four
  int columns;
  int depth;
  int result;
  int left;
  int down;
  int right;
  bool is_lower = false;  ///< quads above the diagonal may be left out
};

// Quads of the result that are made at once: twelve, as there are registers for, and the factors.
inline constexpr int most_quads_down = 2;
inline constexpr int most_quads_across = 6;

/// `down` quads by `across` columns of the result.
template <int down, int across>
DMOCBENCH_INLINE void write_quads(const QuadSizes& sizes, Update update, double* result, const double* left,
                                  const double* right) {
  Quad sums[across][down] = {};
#pragma GCC unroll 4
  for (int k = 0; k < sizes.depth; ++k) {
    Quad numbers[down];
#pragma GCC unroll 2
    for (int d = 0; d < down; ++d) numbers[d] = quad(left + k * sizes.left + 4 * d);
#pragma GCC unroll 8
    for (int c = 0; c < across; ++c) {
      const double factor = right[k * sizes.down + c * sizes.right];
#pragma GCC unroll 2
      for (int d = 0; d < down; ++d) sums[c][d] += numbers[d] * factor;
    }
  }
#pragma GCC unroll 8
  for (int c = 0; c < across; ++c) {
#pragma GCC unroll 2
    for (int d = 0; d < down; ++d) {
      Quad& target = quad(result + c * sizes.result + 4 * d);
      if (update == Update::set) target = sums[c][d];
      if (update == Update::add) target += sums[c][d];
      if (update == Update::subtract) target -= sums[c][d];
    }
  }
}

/// The same where the sizes are known at the time of the call only.
template <int down, int across>
[[gnu::noinline]] void write_quads_of_any(const QuadSizes& sizes, Update update, double* result, const double* left,
                                          const double* right) {
  write_quads<down, across>(sizes, update, result, left, right);
}
using QuadWriter = void (*)(const QuadSizes&, Update, double*, const double*, const double*);
template <int down, int... across>
constexpr std::array<QuadWriter, sizeof...(across)> quad_writers(std::integer_sequence<int, across...> /*counts*/) {
  return {write_quads_of_any<down, across + 1>...};
}
inline constexpr auto across_counts = std::make_integer_sequence<int, most_quads_across>();
/// Indexed by the numbers of quads down and across, less one.
inline constexpr std::array writers_of_quads{quad_writers<1>(across_counts), quad_writers<2>(across_counts)};

inline void carry_out_quads(const QuadSizes& sizes, Update update, double* result, const double* left,
                            const double* right) {
  for (int j = 0; j < sizes.columns; j += most_quads_across) {
    const int across = j + most_quads_across < sizes.columns ? most_quads_across : sizes.columns - j;
    for (int i = sizes.is_lower ? j / 4 * 4 : 0; i < sizes.rows; i += 4 * most_quads_down) {
      const int down = i + 4 < sizes.rows ? 2 : 1;
      writers_of_quads[static_cast<std::size_t>(down - 1)][static_cast<std::size_t>(across - 1)](
          sizes, update, result + i + j * sizes.result, left + i, right + j * sizes.right);
    }
  }
}

/// Columns `j` to the last of the result, where sizes are known at compile time.
template <QuadSizes sizes, Update update, int j = 0>
DMOCBENCH_INLINE void write_columns(double* result, const double* left, const double* right) {
  if constexpr (j < sizes.columns) {
    constexpr int across = j + most_quads_across < sizes.columns ? most_quads_across : sizes.columns - j;
    constexpr int begin = sizes.is_lower ? j / 4 * 4 : 0;
    constexpr int pairs = (sizes.rows - begin) / 8;
    double* const target = result + j * sizes.result;
    const double* const factors = right + j * sizes.right;
    for (int i = begin; i < begin + 8 * pairs; i += 8) {
      write_quads<2, across>(sizes, update, target + i, left + i, factors);
    }
    constexpr int last = begin + 8 * pairs;
    if constexpr (last < sizes.rows) write_quads<1, across>(sizes, update, target + last, left + last, factors);
    write_columns<sizes, update, j + across>(result, left, right);
  }
}

/// A product whose sizes `sizes_of_product` gives as a function of the shape.
template <Update update, class S, class SizesOfProduct>
DMOCBENCH_INLINE void multiply(const S& shape, SizesOfProduct sizes_of_product, double* result, const double* left,
                               const double* right) {
  if constexpr (is_always_plain<S>) {
    write_columns<sizes_of_product(S{0}), update>(result, left, right);
  } else {
    carry_out_quads(sizes_of_product(shape), update, result, left, right);
  }
}

/// The products of columns with a vector, calls `put(j, product)`: `height` numbers lie between columns, the first
/// `rows` of which count. A few numbers are added one by one: just written one by one, they would be late as vectors.
template <class S, class Put>
DMOCBENCH_INLINE void for_dots(const double* matrix, int height, int rows, int columns, const double* vector,
                               const Put& put) {
  for (int j = 0; j < columns; ++j) {
    const double* const column = matrix + j * height;
    if constexpr (known_nodes<S> <= 3) {
      double sum = 0.0;
      for (int i = 0; i < rows; ++i) sum += column[i] * vector[i];
      put(j, sum);
    } else {
      Quad sum{};
      for (int i = 0; i < height; i += 4) sum += quad(column + i) * quad(vector + i);
      put(j, (sum[0] + sum[1]) + (sum[2] + sum[3]));
    }
  }
}

/// The columns become rows.
DMOCBENCH_INLINE void transpose(Quad (&columns)[4]) {
  const Quad a = __builtin_shufflevector(columns[0], columns[1], 0, 4, 2, 6);
  const Quad b = __builtin_shufflevector(columns[0], columns[1], 1, 5, 3, 7);
  const Quad c = __builtin_shufflevector(columns[2], columns[3], 0, 4, 2, 6);
  const Quad d = __builtin_shufflevector(columns[2], columns[3], 1, 5, 3, 7);
  columns[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  columns[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  columns[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  columns[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

/// Copies the lower triangle of a matrix onto its upper one; `rows` is a multiple of four, and so are its columns.
DMOCBENCH_INLINE void mirror(double* matrix, int rows) {
  for (int j = 0; j < rows; j += 4) {
    for (int i = j; i < rows; i += 4) {
      Quad block[4];
      for (int c = 0; c < 4; ++c) block[c] = quad(matrix + i + (j + c) * rows);
      if (i > j) {
        transpose(block);
        for (int c = 0; c < 4; ++c) quad(matrix + j + (i + c) * rows) = block[c];
        continue;
      }
      for (int c = 1; c < 4; ++c) {
        for (int r = 0; r < c; ++r) matrix[i + r + (j + c) * rows] = block[r][c];
      }
    }
  }
}

}  // namespace DMOCBENCH_LANES
}  // namespace dmocbench::kkt
// NOLINTEND(*-avoid-c-arrays,*-reinterpret-cast,*-member-init,*-non-const-parameter,*-implicit-widening*)
