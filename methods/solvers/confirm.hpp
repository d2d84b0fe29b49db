#pragma once

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench {

/// Fills in what we compute ourselves (objective, KKT residual, constraint violation) and judges the solver's word.
///
/// A solution is confirmed as "solved" if stationarity is below `confirmation_factor` · max(tolerance · max(1,
/// |λ|/100), rounding) and violation below `confirmation_factor` · max(tolerance, rounding), where |λ| is the mean
/// magnitude of the multipliers (Ipopt scales its own test by it) and rounding = max(1, largest |λ|) times the
/// program's rounding floor for stationarity. "Acceptable" becomes "solved" by the same test, and "solved" becomes "not
/// confirmed" where it fails.
void confirm(NonlinearProgram& program, double tolerance, Solution& solution);

/// How much larger than the tolerance our residual may be: ours is the plain largest entry, solvers scale theirs.
inline constexpr double confirmation_factor = 10.0;

}  // namespace dmocbench
