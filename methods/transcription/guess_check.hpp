#pragma once

#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/grid.hpp"

namespace dmocbench {

/// What a problem's formulas are like along its guess and at its ends.
struct GuessSurvey {
  double largest_configuration = 0.0;  ///< max |q_i|
  double largest_mass = 0.0;           ///< max |(L_vv)_ij|
};

/// Looks at the guess in 64 points between the ends. Throws `Error` that names the function, the interval of the grid
/// with its time, and the quantity: a guess of the wrong size, a formula that is not a number there, an L_vv that is
/// singular there.
[[nodiscard]] GuessSurvey check_guess(const Problem& problem, const TracedProblem& traced, const Grid& grid);

}  // namespace dmocbench
