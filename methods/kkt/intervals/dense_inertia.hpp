#pragma once

#include <vector>

#include <Eigen/Core>

namespace dmocbench::kkt {

/// The inertia that the factorisation of a small symmetric matrix shows.
struct DenseInertia {
  bool is_singular = false;
  bool is_certain = false;  ///< no eigenvalue of the scaled matrix is near zero
  Eigen::Index negative = 0;
};

/// Memory for `solve_symmetric`, used again from system to system.
struct SymmetricWork {
  /// Takes the memory for systems of `size` unknowns, unless already allocated.
  void make(Eigen::Index size);

  Eigen::VectorXd scale;
  std::vector<int> pivots;
  Eigen::VectorXd numbers;
};

/// Solves a dense symmetric, possibly indefinite system in place (LAPACK's Bunch-Kaufman factors, after scaling rows
/// and columns alike), and counts negative eigenvalues. `matrix`: its lower triangle is read, then overwritten.
[[nodiscard]] DenseInertia solve_symmetric(Eigen::MatrixXd& matrix, Eigen::VectorXd& right_hand_side,
                                           SymmetricWork& work);

}  // namespace dmocbench::kkt
