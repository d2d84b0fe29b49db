#pragma once

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// True at a point that violates constraints and where, to first order, no variable that its bounds leave free can
/// reduce the violation: with r the amounts by which constraints leave their bounds, a step of max(1, |ξᵢ|) along
/// (∂a/∂ξ)ᵀr changes ½|r|² by less than `least_violation_share` · |r|². Solvers without a test of their own for
/// infeasible programs are judged by it where they end. `primal` has variable_count() entries; false where something is
/// not a number.
[[nodiscard]] bool is_point_of_least_violation(NonlinearProgram& program, const Eigen::VectorXd& primal);

/// See above; the gradient of the violation need not vanish exactly where a solve fails.
inline constexpr double least_violation_share = 1e-3;

}  // namespace dmocbench
