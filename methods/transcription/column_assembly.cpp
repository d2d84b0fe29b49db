#include "methods/transcription/column_assembly.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "methods/error.hpp"

namespace dmocbench {

ColumnAssembly::ColumnAssembly(std::vector<std::size_t> firsts, std::size_t size, std::size_t intervals)
    : firsts_(std::move(firsts)), size_(size), intervals_(intervals), columns_(firsts_.size()) {
  std::vector<std::size_t> order(firsts_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return firsts_[a] < firsts_[b]; });
  std::size_t covered = 0;  // entries below are written, set to zero or added to
  for (const std::size_t column : order) {
    const std::size_t first = firsts_[column];
    if (first + intervals_ > size_) throw Error("a column leaves the array that it is assembled to");
    if (first < covered) {
      additions_.push_back({column, additions_.size() * intervals_, first});
      for (; covered < first + intervals_; ++covered) zeros_.push_back(covered);
    } else {
      for (; covered < first; ++covered) zeros_.push_back(covered);
      covered = first + intervals_;
    }
  }
  for (; covered < size_; ++covered) zeros_.push_back(covered);
  scratch_.resize(additions_.size() * intervals_);
}

std::span<double* const> ColumnAssembly::open(VectorOut& result) {
  if (static_cast<std::size_t>(result.size()) != size_)
    throw Error("columns are assembled to an array of wrong length");
  for (std::size_t column = 0; column < columns_.size(); ++column) columns_[column] = result.data() + firsts_[column];
  for (const Addition& addition : additions_) columns_[addition.column] = scratch_.data() + addition.scratch;
  return columns_;
}

void ColumnAssembly::close(VectorOut& result) const {
  for (const std::size_t entry : zeros_) result.data()[entry] = 0.0;
  for (const Addition& addition : additions_) {
    double* target = result.data() + addition.first;
    const double* source = scratch_.data() + addition.scratch;
    for (std::size_t k = 0; k < intervals_; ++k) target[k] += source[k];
  }
}

}  // namespace dmocbench
