#pragma once

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench {

/// Tightens a solution whose rows are all equalities and whose free variables are away from their bounds by Newton
/// steps on the Karush-Kuhn-Tucker system (H, Aᵀ; A, 0), far below the tolerance that a solver was given.
///
/// A step is kept if it lowers the larger of stationarity and violation; the first that does not ends the polish, and
/// so do `most_steps`. That one is kept too where all that it leaves is rounding (`rounding_floor`): residuals of the
/// same size may hide an error that is smooth, and far larger than what rounding alone leaves of the multipliers.
/// Objective, residuals and multipliers of `solution` are those of the polished point. Returns the number of steps
/// kept; 0 where the program is not of this kind, the solution has no multipliers of its own or is not solved.
int polish(NonlinearProgram& program, Solution& solution, int most_steps = 5);

}  // namespace dmocbench
