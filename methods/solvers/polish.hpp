#pragma once

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench {

/// Tightens a solution by Newton steps on the Karush-Kuhn-Tucker system (H, Aᵀ; A, 0), far below the tolerance that the
/// solver was given. All constraints must be equalities, and the free variables away from their bounds.
///
/// A step is kept if it lowers the larger of stationarity and violation. The first one that does not ends the polish,
/// as `most_steps` do; it is still kept if all that it leaves is rounding (`rounding_floor`), because residuals of the
/// same size may hide a smooth error far larger than what rounding leaves of the multipliers. Objective, residuals and
/// multipliers of `solution` become those of the polished point. Returns the number of steps kept; 0 for other
/// programs, or if the solution is not solved or has no multipliers of its own.
int polish(NonlinearProgram& program, Solution& solution, int most_steps = 5);

}  // namespace dmocbench
