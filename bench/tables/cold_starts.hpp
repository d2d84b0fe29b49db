#pragma once

#include "bench/tables/selection.hpp"

namespace dmocbench {

/// The outcomes of solves from many cold starts (from a problem's guess and perturbed guesses, never from a solution),
/// a row for each problem, method, tableau, number of stages, solver, derivatives and intervals.
///
/// The counts best, elsewhere, too_coarse and lost add up to `starts`. An answer is
/// - solved if it is an optimum of the discrete program, confirmed by our own KKT residual;
/// - confirmed if besides each of its intervals, replayed alone, joins the next (`accuracy`); otherwise too_coarse;
/// - best if it is confirmed and its cost is not above the reference's by more than `tolerance`, relative;
///   otherwise elsewhere. The reference is `reference_objective` of the rows; if it is missing, the lowest
///   confirmed cost on that grid by any method and solver.
/// `below_reference` counts the best ones whose cost is below the reference by more than the tolerance. Shares are of
/// all starts, with Wilson's 95 % interval; quartiles of iterations, evaluations and seconds are of the best
/// answers.
[[nodiscard]] Table cold_start_shares(const Selection& rows, double tolerance);

/// Data profiles after Moré and Wild: the share of all starts that are solved and confirmed within a budget of
/// `evaluations` or `seconds`. Curves are steps; curves of one problem and solver end at one budget. The problem
/// `every_problem` is the mean of the problems' shares, where there are several.
[[nodiscard]] Table cold_start_profiles(const Selection& rows);

/// The name in the column `problem` for the mean over all problems.
inline constexpr const char* every_problem = "every_problem";

}  // namespace dmocbench
