#pragma once

#include "methods/indirect/indirect_solution.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// How far an adaptive Runge-Kutta method of order 7(8), started at each node (q, p, ψ)_k, ends from the next node: the
/// largest mismatch, relative to the largest state or costate. Independent of the collocation that found the solution,
/// it confirms state and costate alike; nodes are left where they are, because over the whole horizon the equations of
/// an optimal motion amplify rounding. `tolerance` is absolute and relative. Throws `Error` if a step size vanishes.
[[nodiscard]] double shooting_defect(const Problem& problem, const IndirectSolution& solution,
                                     double tolerance = 1e-14);

}  // namespace dmocbench
