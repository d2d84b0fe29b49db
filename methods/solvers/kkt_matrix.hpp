#pragma once

#include <vector>

#include <Eigen/SparseCore>

namespace dmocbench {

/// Lower triangle of (H + δI, Eᵀ; E, 0), where E are the rows of the Jacobian that count. Fixed variables and the other
/// rows are replaced by unit rows (1 and -1), so that the pattern is the same at every point and the number of negative
/// eigenvalues that belongs to a positive definite H + δI on the null space of E is that of all rows.
/// `hessian`: lower triangle, n x n; `jacobian`: m x n; `free`: n entries; `counts`: m entries.
[[nodiscard]] Eigen::SparseMatrix<double> kkt_matrix(const Eigen::SparseMatrix<double>& hessian, double shift,
                                                     const Eigen::SparseMatrix<double>& jacobian,
                                                     const std::vector<bool>& free, const std::vector<bool>& counts);

}  // namespace dmocbench
