#pragma once

#include <Eigen/Core>

#include "methods/solvers/sqp/quadratic/iterate.hpp"

namespace dmocbench::sqp {

// The null space of A d - s = 0 with the nonbasic columns at rest has the basis Z = (-B⁻¹S; I; 0): one direction per
// superbasic column. Z is never stored.

/// Z w, for a vector over the superbasic columns: all n + m columns.
[[nodiscard]] Eigen::VectorXd null_space_times(const Iterate& iterate, const Eigen::VectorXd& of_superbasics);

/// Zᵀ w, for a vector over the n variables: one entry per superbasic column.
[[nodiscard]] Eigen::VectorXd null_space_transposed_times(const Iterate& iterate, const Eigen::VectorXd& of_variables);

/// ZᵀHZ, dense.
[[nodiscard]] Eigen::MatrixXd reduced_matrix(const Iterate& iterate);

}  // namespace dmocbench::sqp
