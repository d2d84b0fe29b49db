#pragma once

#include "bench/tables/selection.hpp"

namespace dmocbench {

/// The cost of collocation relative to DMOC, solver by solver, from a table of savings_by_solver.
///
/// Quantities are "seconds" of a solve, "seconds_per_iteration", the same without evaluations of the program
/// ("linear_algebra_per_iteration"), "seconds_per_linear_system" (without finding its structure; reported only by
/// interior_point), and "iterations".
///
/// At equal accuracy the cost on N intervals is compared with DMOC's cost at the same error of the objective (straight
/// lines in logarithms between its grids; empty outside of them).
///
/// Rows count if they were solved on the wanted branch and their objective agrees with every other solver's of the same
/// program to 1e-6.
[[nodiscard]] Table advantage_ratios(const Selection& advantage);

}  // namespace dmocbench
