#pragma once

#include "bench/tables/selection.hpp"

namespace dmocbench {

/// What collocation costs beside DMOC, solver by solver, from a table of structure_advantage.
///
/// Quantities are "seconds" of a solve, "seconds_per_iteration", the same without evaluations of the program
/// ("linear_algebra_per_iteration"), "seconds_per_linear_system" (without finding its structure; interior_point alone
/// tells it), and "iterations".
///
/// At equal accuracy the cost on N intervals stands beside what DMOC costs where its error of the objective is the same
/// (straight lines in logarithms between its grids; empty outside of them).
///
/// Rows count if they were solved on the wanted branch and their objective is that of every other solver of the same
/// program, to 1e-6.
[[nodiscard]] Table advantage_ratios(const Selection& advantage);

}  // namespace dmocbench
