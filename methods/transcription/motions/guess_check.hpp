#pragma once

#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/tableau.hpp"
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

/// Refuses a grid on which a path constraint would never act: one that depends on time and that the guess violates in a
/// window of time in which no stage lies. Throws `Error` that names the constraint and the window.
///
/// The guess is sampled at 8 times per interval, but at 4096 at least. A run of samples that violate h_i is a window
/// if no stage lies between the samples around it, and h_i >= 0 at the two stages next to it where q, q̇ and u stay as
/// at its worst sample: then time switches it off, not the motion. Windows that reach an end of the horizon, where
/// bounds of the ends act, and problems with a free horizon, whose stages move, are left to the judgement of the
/// answer.
void check_constraint_windows(const Problem& problem, const TracedProblem& traced, const Tableau& tableau,
                              const Grid& grid);

}  // namespace dmocbench
