#pragma once

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// How far a point is from meeting the Karush-Kuhn-Tucker conditions, computed from the program alone.
struct KktResidual {
  /// Largest entry of ∇φ + (∂a/∂ξ)ᵀλ over the free variables, and largest multiplier of a row that is not an equality;
  /// where a bound at the distance d may take up an entry g, what it leaves: |g| min(1, d), stationarity without its
  /// multiplier, complementarity with it. (The projected gradient min(|g|, d) would ask of a weakly active
  /// bound, g and d both small, the square of what solvers are asked for.)
  double stationarity = 0.0;
  /// Largest amount by which a row or a variable leaves its bounds.
  double constraint_violation = 0.0;
};

/// The residual at `primal` (variable_count() entries) with `multipliers` (constraint_count() entries).
/// NaN where the program gives NaN. Throws `Error` if a size is wrong.
[[nodiscard]] KktResidual kkt_residual(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                       const Eigen::VectorXd& multipliers);

/// The constraint violation alone, for solvers without multipliers.
[[nodiscard]] double constraint_violation(NonlinearProgram& program, const Eigen::VectorXd& primal);

}  // namespace dmocbench
