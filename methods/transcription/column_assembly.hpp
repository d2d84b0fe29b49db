#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// Puts columns of one value per interval together to one long array: value k of column e belongs to entry firsts[e] +
/// k.
///
/// Where two columns meet (the right end of one interval is the left end of the next, so one's `first` is one more than
/// the other's) their values are added. Entries that no column reaches are set to 0. Between `open` and `close` whoever
/// computes the columns writes all of them.
class ColumnAssembly {
 public:
  /// `size` is the length of the array, `intervals` that of a column. Throws `Error` if a column leaves the array.
  ColumnAssembly(std::vector<std::size_t> firsts, std::size_t size, std::size_t intervals);

  /// Where the columns are to be written: most of them in `result` itself. Valid until the next call. Allocates
  /// nothing. Throws `Error` if `result` has not `size` entries.
  [[nodiscard]] std::span<double* const> open(VectorOut& result);
  /// Makes `result` whole, once every column has been written. Allocates nothing.
  void close(VectorOut& result) const;

  [[nodiscard]] std::size_t columns() const noexcept { return firsts_.size(); }
  [[nodiscard]] std::size_t intervals() const noexcept { return intervals_; }

 private:
  struct Addition {
    std::size_t column;   // goes to a scratch column first
    std::size_t scratch;  // where that begins
    std::size_t first;    // and is added from this entry on
  };

  std::vector<std::size_t> firsts_;
  std::size_t size_;
  std::size_t intervals_;
  std::vector<Addition> additions_;
  std::vector<std::size_t> zeros_;
  std::vector<double> scratch_;
  std::vector<double*> columns_;
};

}  // namespace dmocbench
