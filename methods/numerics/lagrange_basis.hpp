#pragma once

#include <Eigen/Core>

namespace dmocbench {

/// The Lagrange polynomials ℓ_j of the nodes c at τ: ℓ_j(c_i) = δ_ij. As many entries as c, whose entries differ.
[[nodiscard]] Eigen::VectorXd lagrange_basis(const Eigen::VectorXd& c, double tau);

}  // namespace dmocbench
