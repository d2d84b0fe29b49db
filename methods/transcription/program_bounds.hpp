#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/problem_bounds.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/program/interval_structure.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/blocks.hpp"
#include "methods/transcription/end_functions.hpp"
#include "methods/transcription/motions/grid.hpp"
#include "methods/transcription/motions/guess_check.hpp"

namespace dmocbench {

/// The bounds of a program, one entry per variable or constraint (row).
struct ProgramBounds {
  Bounds variables;    ///< of the unknowns
  Bounds constraints;  ///< of the constraints
};

/// Bounds of all unknowns and constraints. A clamped end fixes q and, where nodes carry it, p = L_v(q, v) or v. For
/// DMOC the momentum of a clamped end is the bound of that end's equation: p⁰ + (∂A/∂q_0 + W) = 0 (eq:gDLOCP3), -p^T +
/// (∂A/∂q_N + W) = 0 (rem:inifinalvel). Path constraints have the bounds of the velocities, or are not negative
/// (eq:gDLOCP5), or `ProblemBounds::path`. Sums begin at 0, and integrals end within their bounds. `horizon` is the
/// time of the last end. Throws `Error` if the momentum at an end is not finite, or as `require_bounds_of_formulas` and
/// `require_path_constraints_at_ends`. Bounds between the ends bound the unknowns of their nodes, which `grid` has.
[[nodiscard]] ProgramBounds program_bounds(const Problem& problem, const TracedProblem& traced,
                                           const ProblemBounds& bounds, double horizon, const EndRules& ends,
                                           const ProgramBlocks& blocks, const Grid& grid);

/// Throws `Error` unless the same entries have bounds, and equal ones, as before: solvers are set up for that.
void require_same_structure(const Problem& problem, const ProgramBounds& before, const ProgramBounds& now);

/// The floors of a program (`Transcription::rounding_floors`) from max|q| and max|L_vv| over the ends and the guess,
/// and the steps of the intervals.
[[nodiscard]] RoundingFloors rounding_floors_of(const GuessMagnitudes& survey, const Eigen::VectorXd& steps,
                                                const IntervalStructure& structure);

}  // namespace dmocbench
