#pragma once

#include <optional>

#include <Eigen/Core>

// Dense systems of the size of a configuration or an interval. They are solved only here, because Eigen's
// factorisations cost seconds of compile time in every source that uses them.

namespace dmocbench {

/// A⁻¹ B by LU with partial pivoting: A is n × n, B and the result are n × `columns`. A singular A is not an error:
/// entries of the result are then large or not finite. Compiled for `Scalar` double and long double, each for matrices
/// B (`columns` is Eigen::Dynamic) and vectors (1).
template <class Scalar, int columns>
[[nodiscard]] Eigen::Matrix<Scalar, Eigen::Dynamic, columns> solve_square(
    const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& a,
    const Eigen::Matrix<Scalar, Eigen::Dynamic, columns>& b);

/// A⁻¹ b by LU with full pivoting, or nothing if A is singular to rounding. A is n × n; b and the result have n
/// entries.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_if_invertible(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// True if A, an n × n matrix, is not singular to rounding, so that `solve_if_invertible` returns a result.
[[nodiscard]] bool is_invertible(const Eigen::MatrixXd& a);

/// A⁻¹ b by Cholesky's factorisation, or nothing if A is not positive definite. A is n × n and symmetric, and only its
/// lower triangle is read; b and the result have n entries.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_if_positive_definite(const Eigen::MatrixXd& a,
                                                                        const Eigen::VectorXd& b);

/// True if A, a symmetric n × n matrix, is positive definite, so that `solve_if_positive_definite` returns a result.
[[nodiscard]] bool is_positive_definite(const Eigen::MatrixXd& a);

}  // namespace dmocbench
