#pragma once

#include <string>

#include "bench/run/solve_case.hpp"

namespace dmocbench {

/// The next thing to try where a solve has failed, in one sentence that begins with "Try", chosen from what is known of
/// the problem and the solve: angles in degrees, units, a longer horizon, another solver or start. `start` is what
/// --start names. Empty for a case that is solved, or that was stopped from outside.
[[nodiscard]] std::string next_to_try(const SolvedCase& solved, const std::string& start);

}  // namespace dmocbench
