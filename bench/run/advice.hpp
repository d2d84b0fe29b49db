#pragma once

#include <string>

#include "bench/run/solve_case.hpp"

namespace dmocbench {

/// The next thing to try after a failed solve, in one sentence that begins with "Try", chosen from the properties of
/// the problem and the solve: angles in degrees, units, a longer horizon, another solver or start. `start` is the
/// argument of --start. Empty for a case that is solved, or that was stopped from outside.
[[nodiscard]] std::string next_to_try(const SolvedCase& solved, const std::string& start);

/// A sentence on a coordinate that is stated in radians, by its unit or by a Lagrangian of period 2π, and changes by a
/// number that looks like an angle in degrees. Such a problem may be solved all the same. Empty if there is none.
[[nodiscard]] std::string doubt_about_units(const Problem& problem);

/// "3e-05 m, 1e-06 rad, 2e-04 m/s": the largest error of the replayed end, by unit; without units the norm of all.
[[nodiscard]] std::string replay_in_words(const Problem& problem, const ReplayError& replay);

}  // namespace dmocbench
