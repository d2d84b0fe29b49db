#pragma once

#include <vector>

#include "bench/run/experiment.hpp"

namespace dmocbench {

/// The cases of a run: those that the options of an experiment name, with its variants, each once for every tolerance
/// that is compared. Throws `Error` on anything unknown or out of range.
[[nodiscard]] std::vector<Case> cases_of(const Experiment& experiment);

/// The columns of its table.
[[nodiscard]] Columns<SolvedCase> columns_of(const Experiment& experiment);

}  // namespace dmocbench
