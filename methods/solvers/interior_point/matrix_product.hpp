#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/program/block_pattern.hpp"

namespace dmocbench::interior_point {

/// Adds the product of a sparse matrix and a vector, in stretches of the result that stay in the first cache while all
/// runs of the matrix that reach them are added.
class MatrixProduct {
 public:
  /// J x, from the runs of J.
  [[nodiscard]] static MatrixProduct plain(const std::vector<PatternRun>& runs) { return MatrixProduct(runs); }
  /// Jᵀ λ, from the runs of J.
  [[nodiscard]] static MatrixProduct transposed(const std::vector<PatternRun>& runs);
  /// H x of a symmetric matrix, from the runs of its lower triangle, of which each lies on the diagonal or does not
  /// touch it.
  [[nodiscard]] static MatrixProduct symmetric(const std::vector<PatternRun>& runs);

  /// result += matrix · vector; `values`: one per entry of the runs.
  void add(const Eigen::VectorXd& values, const Eigen::VectorXd& vector, Eigen::VectorXd& result) const;

 private:
  explicit MatrixProduct(const std::vector<PatternRun>& terms);

  std::vector<PatternRun> along_;  // entry after entry of the result
  std::vector<PatternRun> into_;   // all into one entry of it
};

}  // namespace dmocbench::interior_point
