#pragma once

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// Multipliers for a point that came without: the λ that minimises |∇φ + (∂a/∂ξ)ᵀλ|₂ over the variables that are
/// neither fixed nor at a bound. The row of an inequality that is not at a bound gets 0.
///
/// "At a bound" means closer than `activity_tolerance` · max(1, |bound|). Signs are not imposed: the residual of the
/// result (kkt_residual.hpp) shows a sign that is wrong, as it shows a point that is not stationary. At a KKT point
/// whose active rows are independent these are the multipliers; where they depend on each other, one of many choices.
///
/// `primal` has variable_count() entries, the result constraint_count(), all NaN where the program gives NaN or
/// infinity. Throws `Error` if the size is wrong.
[[nodiscard]] Eigen::VectorXd least_squares_multipliers(NonlinearProgram& program, const Eigen::VectorXd& primal);

/// How near to its bound a variable or a row counts as active; see above.
inline constexpr double activity_tolerance = 1e-8;

}  // namespace dmocbench
