#pragma once

#include <string>
#include <vector>

#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

/// The columns that `check_independently` fills.
[[nodiscard]] const std::vector<std::string>& independent_check_columns();

/// Looks at a case's trajectory without believing solver or discretisation: `replay_error` (its controls integrated on
/// the continuous equations), `replay_cost` (the cost integrated along), `violation_between_nodes` (of bounds and path
/// constraints where no point imposes them), `free_horizon_residual` (what is left of the condition on T; empty for a
/// fixed horizon). What cannot be computed stays empty, and the message says why.
void check_independently(SolvedCase& solved);

}  // namespace dmocbench
