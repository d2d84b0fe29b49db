#include "methods/solvers/kkt_matrix.hpp"

#include <cstddef>

namespace dmocbench {

Eigen::SparseMatrix<double> kkt_matrix(const Eigen::SparseMatrix<double>& hessian, double shift,
                                       const Eigen::SparseMatrix<double>& jacobian, const std::vector<bool>& free,
                                       const std::vector<bool>& counts) {
  const Eigen::Index n = jacobian.cols();
  const Eigen::Index m = jacobian.rows();
  const auto is_free = [&](Eigen::Index j) { return bool{free[static_cast<std::size_t>(j)]}; };
  const auto is_row = [&](Eigen::Index i) { return bool{counts[static_cast<std::size_t>(i)]}; };
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Eigen::Index i, Eigen::Index j, double value) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    add(j, j, is_free(j) ? shift : 1.0);
    for (Eigen::SparseMatrix<double>::InnerIterator entry(hessian, j); entry; ++entry) {
      add(entry.row(), j, is_free(j) && is_free(entry.row()) ? entry.value() : 0.0);
    }
    for (Eigen::SparseMatrix<double>::InnerIterator entry(jacobian, j); entry; ++entry) {
      add(n + entry.row(), j, is_free(j) && is_row(entry.row()) ? entry.value() : 0.0);
    }
  }
  for (Eigen::Index i = 0; i < m; ++i) add(n + i, n + i, is_row(i) ? 0.0 : -1.0);
  Eigen::SparseMatrix<double> matrix(n + m, n + m);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace dmocbench
