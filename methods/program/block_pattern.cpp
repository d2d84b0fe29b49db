#include "methods/program/block_pattern.hpp"

#include <algorithm>

namespace dmocbench {

std::size_t BlockPattern::append(const PatternRun& run) {
  const Eigen::Index entry = size_;
  runs_.push_back(run);
  runs_.back().entry = entry;
  size_ += run.length;
  return static_cast<std::size_t>(entry);
}

std::size_t BlockPattern::append(std::size_t row, std::size_t column) {
  return append({.row = static_cast<Eigen::Index>(row), .column = static_cast<Eigen::Index>(column)});
}

std::optional<std::size_t> BlockPattern::find(std::size_t row, std::size_t column) const {
  const auto i = static_cast<Eigen::Index>(row);
  const auto j = static_cast<Eigen::Index>(column);
  for (const PatternRun& run : runs_) {
    const Eigen::Index offset = std::max(run.row_step * (i - run.row), run.column_step * (j - run.column));
    if (offset < 0 || offset >= run.length) continue;
    if (run.row + offset * run.row_step != i || run.column + offset * run.column_step != j) continue;
    return static_cast<std::size_t>(run.entry + offset);
  }
  return std::nullopt;
}

SparsityPattern BlockPattern::expand() const {
  SparsityPattern pattern;
  pattern.rows.reserve(size());
  pattern.columns.reserve(size());
  for_each([&](Eigen::Index /*entry*/, int row, int column) {
    pattern.rows.push_back(row);
    pattern.columns.push_back(column);
  });
  return pattern;
}

}  // namespace dmocbench
