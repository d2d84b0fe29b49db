#pragma once

#include <initializer_list>
#include <vector>

#include <Eigen/Core>

#include "methods/program/block_pattern.hpp"

namespace dmocbench::kkt {

struct MatrixTerm;

/// Multiplies a sparse matrix by a vector, run by run of its pattern.
class MatrixProduct {
 public:
  /// J x.
  [[nodiscard]] static MatrixProduct plain(const BlockPattern& jacobian) { return MatrixProduct(jacobian.runs()); }
  /// Jᵀ λ.
  [[nodiscard]] static MatrixProduct transposed(const BlockPattern& jacobian);
  /// H x of a symmetric matrix, from its lower triangle, whose runs lie on the diagonal or do not touch it.
  [[nodiscard]] static MatrixProduct symmetric(const BlockPattern& lower_triangle);

  /// diag(values) x.
  [[nodiscard]] static MatrixProduct diagonal(Eigen::Index size);

 private:
  friend bool set_to_sum_of_products(Eigen::VectorXd& result, const Eigen::VectorXd& start,
                                     std::initializer_list<MatrixTerm> terms);

  explicit MatrixProduct(const std::vector<PatternRun>& terms);

  std::vector<PatternRun> along_;  // entry after entry of the result
  std::vector<PatternRun> into_;   // all into one entry of it
};

/// matrix · vector; `values`: one per entry of the pattern.
struct MatrixTerm {
  const MatrixProduct& matrix;
  const Eigen::VectorXd& values;
  const Eigen::VectorXd& vector;
};

/// result = start + Σ terms, in stretches that stay in the first cache until everything that reaches them is added;
/// false if a number of the result is not finite. `start` may be the result itself.
bool set_to_sum_of_products(Eigen::VectorXd& result, const Eigen::VectorXd& start,
                            std::initializer_list<MatrixTerm> terms);

}  // namespace dmocbench::kkt
