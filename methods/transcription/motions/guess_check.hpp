#pragma once

#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/grid.hpp"

namespace dmocbench {

/// Magnitudes along a problem's guess and at its ends.
struct GuessMagnitudes {
  double largest_configuration = 0.0;  ///< max |q_i|
  double largest_mass = 0.0;           ///< max |(L_vv)_ij|
};

/// Evaluates the problem at 64 points of its guess. Throws `Error` that names the function, the interval of the grid
/// with its time, and the quantity, if the guess has the wrong size, a formula or one of its first or second
/// derivatives is not a number (`FormulaCheck`), or L_vv is singular there. With holonomic
/// constraints (L_vv, Gᵀ; G, 0) has to be regular, and L_vv only if the method `needs_mass`.
[[nodiscard]] GuessMagnitudes check_guess(const Problem& problem, const TracedProblem& traced, const Grid& grid,
                                          bool needs_mass = true);

}  // namespace dmocbench
