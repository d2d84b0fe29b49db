#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/end_functions.hpp"
#include "methods/transcription/layout.hpp"

namespace dmocbench {

/// Everything that a problem bounds, whole and in order.
struct ProblemBounds {
  EndBounds first;
  EndBounds last;
  HorizonBounds horizon;
  Bounds q;  ///< at the nodes
  Bounds v;  ///< at the stages
  Bounds u;  ///< at the stages

  /// The i whose velocity has a bound.
  [[nodiscard]] std::vector<Eigen::Index> bounded_velocities() const;
};

/// The problem's bounds, those of the configuration also applied to both ends. Throws `Error` that names the function
/// if a size is wrong, a bound lies below its partner, no value is left at an end, or the state or horizon that the
/// problem states lies outside.
[[nodiscard]] ProblemBounds problem_bounds(const Problem& problem);

/// The bounds of a program, one entry per variable or row.
struct ProgramBounds {
  Bounds variables;
  Bounds rows;
};

/// Bounds of all unknowns and rows. A clamped end fixes q and, where nodes carry it, p = L_v(q, v) or v; for DMOC the
/// momentum stands in the bounds of the end's row: p⁰ + (∂A/∂q_0 + W) = 0 (eq:gDLOCP3), -p^T + (∂A/∂q_N + W) = 0
/// (rem:inifinalvel). Path rows have the bounds of the velocities, or are not negative. Throws `Error` if a momentum
/// at an end is not finite.
[[nodiscard]] ProgramBounds program_bounds(const Problem& problem, const TracedProblem& traced,
                                           const ProblemBounds& bounds, const EndRules& ends, const Layout& layout);

}  // namespace dmocbench
