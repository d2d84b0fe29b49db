#pragma once

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench {

/// Fills in what we compute ourselves at `solution.primal`: objective, KKT residual, constraint violation; and, where
/// the solver gave no multipliers, their least-squares estimate, so that its point is judged like everyone's.
/// The point has variable_count() entries.
void measure(NonlinearProgram& program, Solution& solution);

/// How many times what `tolerance` allows a measured solution misses, NaN if it is not a number, infinity if it was not
/// measured.
///
/// `StopRule` says what is allowed; its mean is that of the multipliers of rows, for those of bounds are not known.
[[nodiscard]] double times_the_tolerance(const NonlinearProgram& program, double tolerance, const Solution& solution);

/// What becomes of the claim "solved" or "acceptable" of a solution that misses by that many times the tolerance; see
/// `confirm`.
[[nodiscard]] Status judged(Status claim, double scaled_residual);

/// Measures a solution and judges the solver's word.
///
/// It is confirmed as "solved" if it misses by at most `confirmation_factor` times the tolerance (see above).
/// "Acceptable" becomes "solved" by the same test, and "solved" becomes "not confirmed" where it fails; so does
/// "acceptable" beyond a hundred times what confirms.
void confirm(NonlinearProgram& program, double tolerance, Solution& solution);

/// How much larger than the tolerance our residual may be: ours is the plain largest entry, solvers scale theirs.
inline constexpr double confirmation_factor = 10.0;

/// How much farther than a solved one an acceptable solution may be.
inline constexpr double acceptable_factor = 100.0;

}  // namespace dmocbench
