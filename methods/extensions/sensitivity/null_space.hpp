#pragma once

#include <Eigen/Core>

namespace dmocbench {

/// An orthonormal basis of the x with A x = 0 for r × c A of rank r < c: c × (c - r), by Householder's QR of Aᵀ, whose
/// columns are first brought to length 1.
[[nodiscard]] Eigen::MatrixXd null_space(const Eigen::MatrixXd& a);

/// An orthonormal basis of the space that the columns of A span; r × c A has rank c <= r.
[[nodiscard]] Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& a);

/// The last pivot of QR with column pivoting over the first, in absolute value: about 1/condition of a square A, 0 of a
/// singular one up to rounding.
[[nodiscard]] double pivot_ratio(const Eigen::MatrixXd& a);

}  // namespace dmocbench
