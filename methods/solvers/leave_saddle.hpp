#pragma once

#include <functional>

#include <Eigen/Core>

#include "methods/judgement/confirm.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench {

/// Continues from a solved point with negative curvature (`Confirmation::negative_curvature`, of the same point) to a
/// minimum. Solvers stop at saddle points, even at maxima, where a symmetric guess leads there.
///
/// The point is moved along the direction of negative curvature, to either side, by a hundredth, a tenth and then all
/// of its size, and solved again from there by `solve_from`, which judges its answer with `confirmation`; the lower
/// answer replaces the solution, and so on while that one has negative curvature itself. Iterations add up.
///
/// - Where no side leads to a lower cost the solution stays as it is, and its message states the doubt: curvature alone
///   does not withdraw an answer, since round-off next to active bounds can feign it.
/// - Where a side leads to a point that meets the constraints at a lower cost, but to no answer, the status is
///   "stationary, not a minimum".
void leave_saddle(NonlinearProgram& program, double tolerance, const Confirmation& confirmation,
                  const std::function<Solution(const Eigen::VectorXd& start)>& solve_from, Solution& solution);

}  // namespace dmocbench
