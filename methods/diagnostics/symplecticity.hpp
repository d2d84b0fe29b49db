#pragma once

#include <Eigen/Core>

namespace dmocbench {

/// How far a map of (q, p) is from symplectic where its Jacobian is D (2n × 2n): the largest entry of |DᵀΩD - Ω| with
/// Ω = (0, I; -I, 0). Rounding of it is a few ε times the square of D's largest entry.
template <class Matrix>
[[nodiscard]] typename Matrix::Scalar symplecticity_defect(const Matrix& d) {
  const Eigen::Index n = d.rows() / 2;
  Matrix omega = Matrix::Zero(2 * n, 2 * n);
  omega.topRightCorner(n, n).setIdentity();
  omega.bottomLeftCorner(n, n) = -Matrix::Identity(n, n);
  const Matrix defect = d.transpose() * omega * d - omega;
  return defect.template lpNorm<Eigen::Infinity>();
}

}  // namespace dmocbench
