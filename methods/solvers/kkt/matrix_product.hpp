#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/program/block_pattern.hpp"

namespace dmocbench::kkt {

/// Adds the product of a sparse matrix and a vector, in stretches of the result that stay in the first cache while all
/// runs of the matrix that reach them are added.
class MatrixProduct {
 public:
  /// J x.
  [[nodiscard]] static MatrixProduct plain(const BlockPattern& jacobian) { return MatrixProduct(jacobian.runs()); }
  /// Jᵀ λ.
  [[nodiscard]] static MatrixProduct transposed(const BlockPattern& jacobian);
  /// H x of a symmetric matrix, from its lower triangle, whose runs lie on the diagonal or do not touch it.
  [[nodiscard]] static MatrixProduct symmetric(const BlockPattern& lower_triangle);

  /// result += matrix · vector; `values`: one per entry of the pattern.
  void add(const Eigen::VectorXd& values, const Eigen::VectorXd& vector, Eigen::VectorXd& result) const;

 private:
  explicit MatrixProduct(const std::vector<PatternRun>& terms);

  std::vector<PatternRun> along_;  // entry after entry of the result
  std::vector<PatternRun> into_;   // all into one entry of it
};

}  // namespace dmocbench::kkt
