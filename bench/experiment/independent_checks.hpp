#pragma once

#include <optional>

#include "bench/experiment/solve_case.hpp"
#include "methods/diagnostics/replay_error.hpp"

namespace dmocbench {

/// Looks at a trajectory without believing solver or discretisation. What cannot be computed stays empty.
struct IndependentChecks {
  std::optional<ReplayError> replay;              ///< the controls integrated on the continuous equations
  std::optional<double> violation_between_nodes;  ///< of bounds and path constraints where no point imposes them
  std::optional<double> free_horizon_residual;    ///< what is left of the condition on T; none for a fixed horizon
};

/// The controls of the case's trajectory replayed; none, with the reason in the row's message, if that fails.
[[nodiscard]] std::optional<ReplayError> replay(SolvedCase& solved);

[[nodiscard]] IndependentChecks check_independently(SolvedCase& solved);

/// The columns that tell `checks`.
[[nodiscard]] Columns<SolvedCase> columns_of(const IndependentChecks& checks);

/// The column replay_error alone.
[[nodiscard]] Column<SolvedCase> replay_error_column(const std::optional<ReplayError>& replay);

}  // namespace dmocbench
