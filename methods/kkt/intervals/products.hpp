#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "methods/kkt/intervals/kernel_blocks.hpp"

// Products of matrices for the step of a shape S (elimination_step.hpp). If sizes are known at compile time, all loops
// are unrolled, and the sums stay in registers. Else a tile of the result stays in registers while the factors are read
// once, so that most operations are on registers. NOLINTBEGIN(*-avoid-c-arrays,*-member-init): arrays
// that live in registers
namespace dmocbench::kkt {
inline namespace DMOCBENCH_LANES {

/// A matrix in an array: entry (i, j) stands at `first[i * down + j * right]`.
template <class Number>
struct StridedView {
  Number* first;
  std::ptrdiff_t down;
  std::ptrdiff_t right;

  DMOCBENCH_INLINE Number& operator()(int i, int j) const { return first[i * down + j * right]; }
  /// The part that begins with entry (i, j).
  [[nodiscard]] DMOCBENCH_INLINE StridedView from(int i, int j) const {
    return {first + i * down + j * right, down, right};
  }
  [[nodiscard]] DMOCBENCH_INLINE StridedView transposed() const { return {first, right, down}; }
  // NOLINTNEXTLINE(google-explicit-constructor,hicpp-explicit-conversions): as a pointer to numbers is one to constants
  DMOCBENCH_INLINE operator StridedView<const Number>() const { return {first, down, right}; }
};
using Block = StridedView<Lanes>;
using ConstBlock = StridedView<const Lanes>;

DMOCBENCH_INLINE Block block(const MatrixView<Lanes>& matrix) { return {matrix.first, 1, matrix.rows}; }
DMOCBENCH_INLINE ConstBlock block(const MatrixView<const Lanes>& matrix) { return {matrix.first, 1, matrix.rows}; }
template <class S, auto rows, auto columns>
DMOCBENCH_INLINE Block block(LaneMatrix<S, rows, columns>& matrix) {
  return {matrix.data(), 1, matrix.height()};
}
/// An array as a matrix of one column.
DMOCBENCH_INLINE Block column(Lanes* array) { return {array, 1, 0}; }
DMOCBENCH_INLINE ConstBlock column(const Lanes* array) { return {array, 1, 0}; }

/// The entries of a product to compute: `lower` without entries above the diagonal. Entries less than `tile_columns`
/// above it are written nevertheless.
enum class Part : unsigned char { all, lower };

/// rows x columns sums of `depth` products each.
struct ProductSizes {
  int rows;
  int columns;
  int depth;
  Part part = Part::all;
  [[nodiscard]] DMOCBENCH_INLINE ProductSizes of_depth(int other) const { return {rows, columns, other, part}; }
};

/// result = left right, or the product is added to the result or subtracted from it.
struct Product {
  enum class Update : unsigned char { set, add, subtract };
  Update update;
  Block result;
  ConstBlock left;
  ConstBlock right;
  ProductSizes sizes;
};

// Sums that are made at once: as many as there are registers for, after the registers for the factors.
inline constexpr int tile_rows = Lanes::width == 8 ? 6 : 4;
inline constexpr int tile_columns = Lanes::width == 8 ? 4 : 3;

/// The tile of the result that begins with entry (i, j).
template <int rows, int columns>
[[gnu::noinline]] void write_tile(const Product& product, int i, int j) {
  using Numbers = std::remove_all_extents_t<decltype(Lanes::part)>;
  const Block result = product.result.from(i, j);
  for (int part = 0; part < Lanes::parts; ++part) {
    Numbers sums[columns][rows] = {};
    ConstBlock left = product.left.from(i, 0);
    ConstBlock right = product.right.from(0, j);
    for (int k = 0; k < product.sizes.depth; ++k) {
      Numbers numbers[rows];
#pragma GCC unroll 8
      for (int row = 0; row < rows; ++row) numbers[row] = left(row, 0).part[part];
#pragma GCC unroll 8
      for (int c = 0; c < columns; ++c) {
        const Numbers factor = right(0, c).part[part];
#pragma GCC unroll 8
        for (int row = 0; row < rows; ++row) sums[c][row] += numbers[row] * factor;
      }
      left = left.from(0, 1);
      right = right.from(1, 0);
    }
#pragma GCC unroll 8
    for (int c = 0; c < columns; ++c) {
#pragma GCC unroll 8
      for (int row = 0; row < rows; ++row) {
        Numbers& target = result(row, c).part[part];
        if (product.update == Product::Update::set) target = sums[c][row];
        if (product.update == Product::Update::add) target += sums[c][row];
        if (product.update == Product::Update::subtract) target -= sums[c][row];
      }
    }
  }
}

using TileWriter = void (*)(const Product&, int, int);
template <int rows, int... columns>
constexpr std::array<TileWriter, sizeof...(columns)> writers_of_height(
    std::integer_sequence<int, columns...> /*counts*/) {
  return {write_tile<rows, columns + 1>...};
}
template <int... rows>
constexpr auto writers_of_tiles(std::integer_sequence<int, rows...> /*counts*/) {
  return std::array{writers_of_height<rows + 1>(std::make_integer_sequence<int, tile_columns>())...};
}
/// Indexed by the numbers of rows and columns of a tile, less one.
inline constexpr auto tile_writers = writers_of_tiles(std::make_integer_sequence<int, tile_rows>());

/// Start of a part when `length` is split into `count` parts that differ by at most one.
inline int begin_of_part(int part, int count, int length) { return part * length / count; }

inline void carry_out(const Product& product) {
  const auto [rows, columns, depth, part] = product.sizes;
  if (depth == 0 && product.update != Product::Update::set) return;
  const int across = (columns + tile_columns - 1) / tile_columns;
  for (int a = 0; a < across; ++a) {
    const int j = begin_of_part(a, across, columns);
    const int width = begin_of_part(a + 1, across, columns) - j;
    const int begin = part == Part::lower ? j : 0;
    const int length = rows - begin;
    const int down = (length + tile_rows - 1) / tile_rows;
    for (int d = 0; d < down; ++d) {
      const int i = begin + begin_of_part(d, down, length);
      const int height = begin + begin_of_part(d + 1, down, length) - i;
      tile_writers[static_cast<std::size_t>(height - 1)][static_cast<std::size_t>(width - 1)](product, i, j);
    }
  }
}

/// Calls `of_entry(i, j)` for the entries of a matrix, column by column.
template <class OfEntry>
DMOCBENCH_INLINE void for_entries(const ProductSizes& sizes, const OfEntry& of_entry) {
  for (int j = 0; j < sizes.columns; ++j) {
    for (int i = sizes.part == Part::lower ? j : 0; i < sizes.rows; ++i) of_entry(i, j);
  }
}

/// Calls `of_tile(i, j, sizes)` for the parts of a product, which begin with entry (i, j): for every entry if sizes are
/// known at compile time, so that an entry stays in a register until it is finished, else once for all.
template <class S, class OfTile>
DMOCBENCH_INLINE void for_tiles(const ProductSizes& sizes, const OfTile& of_tile) {
  if constexpr (is_always_plain<S>) {
    for_entries(sizes, [&](int i, int j) DMOCBENCH_INLINED {
      of_tile(i, j, ProductSizes{1, 1, sizes.depth, sizes.part});
    });
  } else {
    of_tile(0, 0, sizes);
  }
}
/// The same for rows or columns: calls `of_range(first, count)`.
template <class S, class OfRange>
DMOCBENCH_INLINE void for_ranges(int size, const OfRange& of_range) {
  if constexpr (is_always_plain<S>) {
    for (int i = 0; i < size; ++i) of_range(i, 1);
  } else if (size > 0) {
    of_range(0, size);
  }
}

/// The product, or the old value plus or minus the product. Sums begin with the old value if sizes are known, else they
/// are added to it or subtracted from it.
template <class S, Product::Update update>
DMOCBENCH_INLINE void update_by_product(const Block& result, const ConstBlock& left, const ConstBlock& right,
                                        const ProductSizes& sizes) {
  if constexpr (is_always_plain<S>) {
    for_entries(sizes, [&](int i, int j) DMOCBENCH_INLINED {
      Lanes sum = update == Product::Update::set ? Lanes{} : result(i, j);
      for (int k = 0; k < sizes.depth; ++k) {
        if (update == Product::Update::subtract) {
          sum -= left(i, k) * right(k, j);
        } else {
          sum += left(i, k) * right(k, j);
        }
      }
      result(i, j) = sum;
    });
  } else {
    carry_out({update, result, left, right, sizes});
  }
}
template <class S>
DMOCBENCH_INLINE void set_product(const Block& result, const ConstBlock& left, const ConstBlock& right,
                                  const ProductSizes& sizes) {
  update_by_product<S, Product::Update::set>(result, left, right, sizes);
}
template <class S>
DMOCBENCH_INLINE void add_product(const Block& result, const ConstBlock& left, const ConstBlock& right,
                                  const ProductSizes& sizes) {
  update_by_product<S, Product::Update::add>(result, left, right, sizes);
}
template <class S>
DMOCBENCH_INLINE void subtract_product(const Block& result, const ConstBlock& left, const ConstBlock& right,
                                       const ProductSizes& sizes) {
  update_by_product<S, Product::Update::subtract>(result, left, right, sizes);
}

/// Calls `put(i, j, difference)` for start values minus a product. Only known sizes leave the start values as they are:
/// a result that is put straight to its place need not be stored twice.
template <class S, class Put>
DMOCBENCH_INLINE void put_difference(const Block& start, const ConstBlock& left, const ConstBlock& right,
                                     const ProductSizes& sizes, const Put& put) {
  if constexpr (is_always_plain<S>) {
    for_entries(sizes, [&](int i, int j) DMOCBENCH_INLINED {
      Lanes sum = start(i, j);
      for (int k = 0; k < sizes.depth; ++k) sum -= left(i, k) * right(k, j);
      put(i, j, sum);
    });
  } else {
    subtract_product<S>(start, left, right, sizes);
    for_entries(sizes, [&](int i, int j) DMOCBENCH_INLINED { put(i, j, start(i, j)); });
  }
}

/// The product plus terms, which `add_terms(i, j, sum)` adds: before the products if sizes are known, else after them.
/// `left` may be a function of (i, j) if sizes are known.
template <class S, class Left, class AddTerms>
DMOCBENCH_INLINE void set_product_and_terms(const Block& result, const Left& left, const ConstBlock& right,
                                            const ProductSizes& sizes, const AddTerms& add_terms) {
  if constexpr (is_always_plain<S>) {
    for_entries(sizes, [&](int i, int j) DMOCBENCH_INLINED {
      Lanes sum{};
      add_terms(i, j, sum);
      for (int k = 0; k < sizes.depth; ++k) sum += left(i, k) * right(k, j);
      result(i, j) = sum;
    });
  } else {
    carry_out({Product::Update::set, result, left, right, sizes});
    for_entries(sizes, [&](int i, int j) DMOCBENCH_INLINED { add_terms(i, j, result(i, j)); });
  }
}

/// Zeros where products of the lower part of a matrix write above its diagonal: these add to the old values.
inline void clear_above_diagonal(const Block& matrix, int size) {
  for (int j = 0; j < size; ++j) {
    for (int i = j < tile_columns ? 0 : j - tile_columns + 1; i < j; ++i) matrix(i, j) = Lanes{};
  }
}

}  // namespace DMOCBENCH_LANES
}  // namespace dmocbench::kkt
// NOLINTEND(*-avoid-c-arrays,*-member-init)
