#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/intervals/segment_kernel.hpp"
#include "methods/solvers/interior_point/intervals/shape.hpp"

namespace dmocbench::interior_point {

/// An entry of an interval's blocks in natural order: unknowns (x_{k+1}, y_k, x_k, s_k, θ), equalities (those of node
/// k, then the interval's own).
struct LocalEntry {
  enum class Block : unsigned char { equality, carry, hessian, inequality };
  Block block;
  int row;
  int column;
  Source source;
  std::size_t first;  ///< that of interval k stands at `first` + k
};

/// An entry of the KKT matrix that belongs to the ends of the horizon: between rows and unknowns of the first and the
/// last node and of the border.
struct EndEntry {
  Source source;  ///< hessian or jacobian
  std::size_t entry;
  std::size_t row;     ///< of the program: an unknown (hessian) or a row (jacobian)
  std::size_t column;  ///< of the program: an unknown
};

/// A column of derivatives that only the intervals from `begin` on have, `length` of them. It is copied to the array of
/// padded columns, N entries from `padded_first` on, zero elsewhere.
struct PaddedColumn {
  Source source;
  std::size_t entry;
  std::size_t begin;
  std::size_t length;
  std::size_t padded_first;
};

/// What of a program belongs to its intervals, and what to the ends.
struct IntervalEntries {
  Shape shape{};
  std::size_t intervals = 0;

  // First entries of columns of unknowns and rows: that of node or interval k stands at first + k.
  std::vector<std::size_t> node_unknowns;
  std::vector<std::size_t> inner_unknowns;
  std::vector<std::size_t> node_rows;
  std::vector<std::size_t> interval_rows;
  std::vector<std::size_t> inequality_rows;

  std::vector<std::size_t> shared_unknowns;
  std::vector<bool> inner_is_fixed;                         ///< one per inner unknown
  std::array<std::vector<std::size_t>, 2> single_unknowns;  ///< further unknowns of the first and of the last node
  std::vector<std::size_t> single_rows;                     ///< further rows of the ends, and those of the border
  std::vector<LocalEntry> local;
  std::vector<PaddedColumn> padded;
  std::vector<EndEntry> ends;
};

/// Looks up where a program's runs go. The reason instead if the program has no interval structure, or one that is not
/// the same in all intervals, or fixed unknowns between its ends.
[[nodiscard]] tl::expected<IntervalEntries, std::string> interval_entries(const NonlinearProgram& program);

}  // namespace dmocbench::interior_point
