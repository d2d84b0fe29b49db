#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/end_functions.hpp"
#include "methods/transcription/layout.hpp"

namespace dmocbench {

/// The problem's bounds, complete (no part is empty), those of q also applied to both ends. Throws `Error` that names
/// the function if a size is wrong, a lower bound is above the upper one, no value is left at an end (for v by those of
/// the ends and of the stages together), or the state or the horizon of the problem lies outside.
[[nodiscard]] ProblemBounds problem_bounds(const Problem& problem);

/// The same for bounds that are given in place of the problem's, whose states may lie outside of them.
[[nodiscard]] ProblemBounds complete_bounds(const Problem& problem, ProblemBounds bounds);

/// The bounds of a program, one entry per variable or constraint (row).
struct ProgramBounds {
  Bounds variables;    ///< of the unknowns
  Bounds constraints;  ///< of the constraints
};

/// Bounds of all unknowns and constraints. A clamped end fixes q and, where nodes carry it, p = L_v(q, v) or v. For
/// DMOC the momentum of a clamped end is the bound of that end's equation: p⁰ + (∂A/∂q_0 + W) = 0 (eq:gDLOCP3), -p^T +
/// (∂A/∂q_N + W) = 0 (rem:inifinalvel). Path constraints have the bounds of the velocities, or are not negative
/// (eq:gDLOCP5). `horizon` is the time of the last end. Throws `Error` if the momentum at an end is not finite, or as
/// `require_path_constraints_at_ends`.
[[nodiscard]] ProgramBounds program_bounds(const Problem& problem, const TracedProblem& traced,
                                           const ProblemBounds& bounds, double horizon, const EndRules& ends,
                                           const Layout& layout);

/// Throws `Error` unless the same entries have bounds, and equal ones, as before: solvers are set up for that.
void require_same_structure(const Problem& problem, const ProgramBounds& before, const ProgramBounds& now);

}  // namespace dmocbench
