#include "methods/kkt/intervals/dense_inertia.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <lapacke.h>

namespace dmocbench::kkt {

namespace {

static_assert(std::is_same_v<lapack_int, int>);

/// Multiplies rows and columns, given by the lower triangle, by factors that bring the largest entries near 1.
void equilibrate(Eigen::MatrixXd& lower, Eigen::VectorXd& factors) {
  const Eigen::Index n = lower.rows();
  factors.setZero(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) {
      factors[i] = std::max(factors[i], std::abs(lower(i, j)));
      factors[j] = std::max(factors[j], std::abs(lower(i, j)));
    }
  }
  for (double& factor : factors) factor = factor > 0.0 ? 1.0 / std::sqrt(factor) : 1.0;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) lower(i, j) = factors[i] * lower(i, j) * factors[j];
  }
}

/// Smallest magnitude of the eigenvalues of a symmetric block (a, b; b, c).
double smallest_eigenvalue(double a, double b, double c) {
  const double largest = 0.5 * (std::abs(a + c) + std::hypot(a - c, 2.0 * b));
  return largest > 0.0 ? std::abs(a * c - b * b) / largest : 0.0;
}

/// Counts by the blocks of one or two rows of D; a block of two has one eigenvalue of either sign.
DenseInertia inertia_of(const Eigen::MatrixXd& factors, const std::vector<int>& pivots) {
  const Eigen::Index n = factors.rows();
  constexpr double far_from_zero = 1e-11;  // hundreds of times the rounding of dependent rows
  // Elimination turns a dependent row into a few units of rounding per row.
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

void SymmetricWork::make(Eigen::Index size) {
  constexpr Eigen::Index columns_at_once = 64;
  scale.resize(size);
  pivots.resize(static_cast<std::size_t>(size));
  numbers.resize(size * columns_at_once);
}

DenseInertia solve_symmetric(Eigen::MatrixXd& matrix, Eigen::VectorXd& right_hand_side, SymmetricWork& work) {
  const Eigen::Index n = matrix.rows();
  if (n == 0) return {.is_certain = true};
  if (!matrix.allFinite() || !right_hand_side.allFinite()) return {.is_singular = true};
  work.make(n);
  equilibrate(matrix, work.scale);
  right_hand_side.array() *= work.scale.array();
  // Not LAPACKE's usual functions, which allocate and look for NaN again.
  const auto order = static_cast<lapack_int>(n);
  const lapack_int info = LAPACKE_dsytrf_work(LAPACK_COL_MAJOR, 'L', order, matrix.data(), order, work.pivots.data(),
                                              work.numbers.data(), static_cast<lapack_int>(work.numbers.size()));
  if (info != 0) return {.is_singular = true};
  LAPACKE_dsytrs_work(LAPACK_COL_MAJOR, 'L', order, 1, matrix.data(), order, work.pivots.data(), right_hand_side.data(),
                      order);
  right_hand_side.array() *= work.scale.array();
  return inertia_of(matrix, work.pivots);
}

}  // namespace dmocbench::kkt
