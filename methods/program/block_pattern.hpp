#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace dmocbench {

/// The entries of a sparse matrix one by one; entry e stands at (rows[e], columns[e]).
struct SparsityPattern {
  std::vector<int> rows;     ///< of each entry
  std::vector<int> columns;  ///< of each entry
  /// The number of entries.
  [[nodiscard]] std::size_t size() const noexcept { return rows.size(); }
};

/// Consecutive entries of a sparse matrix: entry `entry` + i stands at (row + i row_step, column + i column_step), i =
/// 0 to length - 1. A step is 0 or 1, so a run is a stretch of a diagonal, a row or a column, or a single entry.
struct PatternRun {
  Eigen::Index entry = 0;        ///< its number among all entries, of the first of the run
  Eigen::Index row = 0;          ///< of the first entry
  Eigen::Index column = 0;       ///< of the first entry
  Eigen::Index row_step = 0;     ///< from an entry to the next one
  Eigen::Index column_step = 0;  ///< from an entry to the next one
  Eigen::Index length = 1;       ///< how many entries the run has
};

/// The positions of the entries of a sparse matrix: runs, in the order of the array of values. No position occurs
/// twice.
///
/// The size of a pattern does not depend on the number of intervals: a quantity that an interval contributes is one run
/// over all of them. A program without such structure has runs of one entry.
class BlockPattern {
 public:
  /// Adds a run and returns the number of its first entry.
  std::size_t append(const PatternRun& run);
  /// Adds one entry and returns its number.
  std::size_t append(std::size_t row, std::size_t column);

  /// All runs, in the order in which they were added.
  [[nodiscard]] const std::vector<PatternRun>& runs() const noexcept { return runs_; }
  /// Number of entries.
  [[nodiscard]] std::size_t size() const noexcept { return static_cast<std::size_t>(size_); }
  /// The number of the entry at a position, if there is one.
  [[nodiscard]] std::optional<std::size_t> find(std::size_t row, std::size_t column) const;
  /// Row and column of every single entry.
  [[nodiscard]] SparsityPattern expand() const;

  /// Calls visit(entry, row, column) for every entry in order; `entry` is an Eigen::Index, `row` and `column` are int.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const PatternRun& run : runs_) {
      for (Eigen::Index i = 0; i < run.length; ++i) {
        visit(run.entry + i, static_cast<int>(run.row + i * run.row_step),
              static_cast<int>(run.column + i * run.column_step));
      }
    }
  }

 private:
  std::vector<PatternRun> runs_;
  Eigen::Index size_ = 0;
};

}  // namespace dmocbench
