#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace dmocbench::speed {

/// Memory for columns of one number per interval.
///
/// Columns begin with a cache line, but not a power of two apart: else they would compete for the same few lines of the
/// first-level cache. (In a program they stand as the pattern has it.)
class IntervalColumns {
 public:
  IntervalColumns(std::size_t count, std::size_t intervals);

  [[nodiscard]] std::span<double* const> columns() const noexcept { return columns_; }
  /// The numbers of one interval.
  [[nodiscard]] std::vector<double> row(std::size_t interval) const;

 private:
  std::vector<double> values_;
  std::vector<double*> columns_;
};

}  // namespace dmocbench::speed
