#include "methods/solvers/interior_point/intervals/symmetric_solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <lapacke.h>

namespace dmocbench::interior_point {

namespace {

/// Factors that bring the largest entries of rows and columns near 1.
Eigen::VectorXd equilibration(const Eigen::MatrixXd& lower) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(lower.rows());
  for (Eigen::Index j = 0; j < lower.cols(); ++j) {
    for (Eigen::Index i = j; i < lower.rows(); ++i) {
      largest[i] = std::max(largest[i], std::abs(lower(i, j)));
      largest[j] = std::max(largest[j], std::abs(lower(i, j)));
    }
  }
  return largest.unaryExpr([](double size) { return size > 0.0 ? 1.0 / std::sqrt(size) : 1.0; });
}

/// Smallest magnitude of the eigenvalues of a symmetric block (a, b; b, c).
double smallest_eigenvalue(double a, double b, double c) {
  const double largest = 0.5 * (std::abs(a + c) + std::hypot(a - c, 2.0 * b));
  return largest > 0.0 ? std::abs(a * c - b * b) / largest : 0.0;
}

/// From the blocks of one or two rows of D; a block of two has one eigenvalue of either sign.
DenseInertia inertia_of(const Eigen::MatrixXd& factors, const std::vector<lapack_int>& pivots) {
  const Eigen::Index n = factors.rows();
  constexpr double far_from_zero = 1e-11;  // hundreds of times what rounding leaves of dependent rows
  // What elimination leaves of dependent rows is rounding, a few units of it per row.
  const double rounding = 10.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
  DenseInertia inertia;
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (pivots[static_cast<std::size_t>(i)] < 0) {
      smallest = std::min(smallest, smallest_eigenvalue(factors(i, i), factors(i + 1, i), factors(i + 1, i + 1)));
      ++inertia.negative;
      ++i;
    } else {
      smallest = std::min(smallest, std::abs(factors(i, i)));
      if (factors(i, i) < 0.0) ++inertia.negative;
    }
  }
  inertia.is_singular = !(smallest > rounding);
  inertia.is_certain = smallest > far_from_zero;
  return inertia;
}

}  // namespace

DenseInertia solve_symmetric(Eigen::MatrixXd& matrix, Eigen::VectorXd& right_hand_side) {
  const Eigen::Index n = matrix.rows();
  if (n == 0) return {.is_certain = true};
  if (!matrix.allFinite() || !right_hand_side.allFinite()) return {.is_singular = true};
  const Eigen::VectorXd scale = equilibration(matrix);
  matrix = (scale.asDiagonal() * matrix * scale.asDiagonal()).eval();
  right_hand_side.array() *= scale.array();
  std::vector<lapack_int> pivots(static_cast<std::size_t>(n));
  const auto order = static_cast<lapack_int>(n);
  const lapack_int info = LAPACKE_dsytrf(LAPACK_COL_MAJOR, 'L', order, matrix.data(), order, pivots.data());
  if (info != 0) return {.is_singular = true};
  LAPACKE_dsytrs(LAPACK_COL_MAJOR, 'L', order, 1, matrix.data(), order, pivots.data(), right_hand_side.data(), order);
  right_hand_side.array() *= scale.array();
  return inertia_of(matrix, pivots);
}

}  // namespace dmocbench::interior_point
