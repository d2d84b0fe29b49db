#pragma once

#include <Eigen/Core>

namespace dmocbench::interior_point {

/// What the factorisation of a small symmetric matrix tells.
struct DenseInertia {
  bool is_singular = false;
  bool is_certain = false;  ///< no eigenvalue of the scaled matrix is near zero
  Eigen::Index negative = 0;
};

/// Solves a dense symmetric, possibly indefinite system in place (LAPACK's Bunch-Kaufman factors, after scaling rows
/// and columns alike), and counts negative eigenvalues. `matrix`: its lower triangle is read, then overwritten.
[[nodiscard]] DenseInertia solve_symmetric(Eigen::MatrixXd& matrix, Eigen::VectorXd& right_hand_side);

}  // namespace dmocbench::interior_point
