#pragma once

#include "methods/mechanics/bounds.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

/// Throws `Error` that names a path constraint which the ends alone break: one that reads no control and no component
/// of q, v or T that is left free there, and is negative by more than rounding.
///
/// Programs have h >= 0 at stages only (eq:gDLOCP5), so that none of their constraints would show it; yet no motion
/// with such an end satisfies h >= 0. `horizon` is the time of the last end, where it is fixed.
void require_path_constraints_at_ends(const Problem& problem, const TracedProblem& traced, const ProblemBounds& bounds,
                                      double horizon);

/// Throws `Error` that reports by how much an end whose configuration is given leaves the holonomic constraints, g(q) =
/// 0, or one whose velocity is given too leaves G v = 0.
void require_holonomic_constraints_at_ends(const Problem& problem, const TracedProblem& traced,
                                           const ProblemBounds& bounds);

}  // namespace dmocbench
