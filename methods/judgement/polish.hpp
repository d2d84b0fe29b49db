#pragma once

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench {

/// Tightens a solution by Newton steps (`NewtonCorrections`), far below the tolerance that the solver was given.
///
/// A step is kept if it lowers the larger of stationarity and violation. The first one that does not ends the polish,
/// as `most_steps` do; it is still kept if all that it leaves is rounding (`RoundingFloors`), because residuals of the
/// same size may hide a smooth error far larger than the rounding in the multipliers. Objective, residuals and
/// multipliers of `solution` are set to the polished point's. Returns the number of steps kept; 0 if the solution is
/// not solved, has no multipliers of its own, or its Newton step cannot be computed. It ends with its `StopScope`.
int polish(NonlinearProgram& program, Solution& solution, int most_steps = 5);

/// Gives an answer the Newton steps that it lacks, if it has multipliers of its own:
///
/// - One that was not confirmed because a Newton step would still move it (`confirm`), or at which a solver stopped
///   within `acceptable_factor` of the tolerance that confirms it, whatever the solver calls that. It becomes solved if
///   a further step would not move it and its residuals are confirmed at this tolerance, and its message reports the
///   number of steps it took. It becomes solved as well if answers on both sides of it, along the step, meet the
///   conditions to the tolerance at the same cost: the trajectory is one of many, which its message reports. Otherwise
///   `solution` is unchanged.
/// - A solved one whose residuals are above the tolerance and allowed only as rounding (`StopRule`). It takes steps as
///   long as each leaves less than half of the residuals: the rest is rounding, and was measured.
///
/// Where its `StopScope` ends it before an answer is confirmed the status becomes "time limit" or "interrupted",
/// because nothing is known then. Returns the number of steps kept.
int settle(NonlinearProgram& program, double tolerance, Solution& solution);

}  // namespace dmocbench
