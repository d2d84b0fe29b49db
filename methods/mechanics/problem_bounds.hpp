#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The problem's bounds, complete (no part is empty), with q's also applied to both ends and to the times between them,
/// which ascend. Throws `Error` that names the function if a size is wrong, a lower bound is above the upper one, no
/// value is left at an end (for v by bounds of the ends and of the stages together), or the state or the horizon of the
/// problem lies outside. How many entries
/// `path` and `integrals` need, only the formulas show (`require_bounds_of_formulas`).
[[nodiscard]] ProblemBounds problem_bounds(const Problem& problem);

/// The same for bounds that are given in place of the problem's, whose states may lie outside of them.
[[nodiscard]] ProblemBounds complete_bounds(const Problem& problem, ProblemBounds bounds);

/// Throws `Error` unless there is a bound for each of `path_constraints` (or for none of them) and for each of
/// `integrals`.
void require_bounds_of_formulas(const Problem& problem, const ProblemBounds& bounds, Eigen::Index path_constraints,
                                Eigen::Index integrals);

}  // namespace dmocbench
