#pragma once

#include <cmath>

#include <Eigen/Core>

namespace dmocbench {

/// The sizes below which residuals of a program are rounding: about ε · (size of the terms of a constraint).
///
/// Each constraint and each variable has a floor of its own, so that a constraint whose terms are large excuses nothing
/// elsewhere.
struct RoundingFloors {
  double smallest = 0.0;  ///< of all constraints and variables
  double largest = 0.0;   ///< of all constraints and variables
  /// One for every constraint; empty where all floors are equal.
  Eigen::VectorXd constraints;
  /// One for every variable, for its entry of (∂a/∂ξ)ᵀλ with |λ| = 1; empty where all floors are equal.
  Eigen::VectorXd variables;

  /// True if one floor holds for all.
  [[nodiscard]] bool are_equal() const noexcept { return constraints.size() == 0; }
  /// The floor of constraint i.
  [[nodiscard]] double of_constraint(Eigen::Index i) const { return are_equal() ? largest : constraints[i]; }
  /// The Euclidean norm of the floors of all `count` constraints.
  [[nodiscard]] double norm_of_constraints(Eigen::Index count) const {
    return are_equal() ? largest * std::sqrt(static_cast<double>(count)) : constraints.norm();
  }
  /// The floor of variable j.
  [[nodiscard]] double of_variable(Eigen::Index j) const { return are_equal() ? largest : variables[j]; }
};

}  // namespace dmocbench
