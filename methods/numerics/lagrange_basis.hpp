#pragma once

#include <Eigen/Core>

namespace dmocbench {

/// The Lagrange polynomials ℓ_j of the nodes c at τ: ℓ_j(c_i) = δ_ij. As many entries as c, whose entries differ.
[[nodiscard]] inline Eigen::VectorXd lagrange_basis(const Eigen::VectorXd& c, double tau) {
  Eigen::VectorXd values = Eigen::VectorXd::Ones(c.size());
  for (Eigen::Index j = 0; j < c.size(); ++j) {
    for (Eigen::Index i = 0; i < c.size(); ++i) {
      if (i != j) values[j] *= (tau - c[i]) / (c[j] - c[i]);
    }
  }
  return values;
}

}  // namespace dmocbench
