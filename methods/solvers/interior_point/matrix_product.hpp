#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/solvers/interior_point/pattern_runs.hpp"

namespace dmocbench::interior_point {

/// Adds the product of a sparse matrix and a vector. Runs whose results begin side by side belong to one column of
/// unknowns or rows; all columns advance together, some intervals at a time, so that every number is fetched from
/// memory once however many runs read or write it.
class MatrixProduct {
 public:
  /// J x, from the runs of J.
  [[nodiscard]] static MatrixProduct plain(std::vector<PatternRun> runs) { return MatrixProduct(std::move(runs)); }
  /// Jᵀ λ, from the runs of J.
  [[nodiscard]] static MatrixProduct transposed(const std::vector<PatternRun>& runs);
  /// H x of a symmetric matrix, from the runs of its lower triangle.
  [[nodiscard]] static MatrixProduct symmetric(const std::vector<PatternRun>& runs);

  /// result += matrix · vector; `values`: one per entry of the pattern that the runs were made from.
  void add(const Eigen::VectorXd& values, const Eigen::VectorXd& vector, Eigen::VectorXd& result) const;

 private:
  /// A stretch of the result, and the runs that are added to it entry by entry.
  struct Column {
    Eigen::Index first;
    Eigen::Index length;
    std::vector<PatternRun> runs;
  };

  explicit MatrixProduct(std::vector<PatternRun> terms);

  std::vector<Column> columns_;
  std::vector<PatternRun> into_;  // all into one entry of the result
  Eigen::Index longest_ = 0;      // of the columns
};

}  // namespace dmocbench::interior_point
