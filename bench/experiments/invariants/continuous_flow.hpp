#pragma once

#include <vector>

#include "bench/experiments/invariants/simulated_tables.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// The forced Noether theorem of the continuous system (eq:noether_force): motions under smooth controls, integrated as
/// replays are. A row per system with a symmetry; the columns are declared in the source.
[[nodiscard]] Table flow_momentum_table();

/// The form Ω_L on TQ along the unforced flow, (F_L^T)*Ω_L - Ω_L, the largest over the states. A row per system; the
/// columns are declared in the source.
[[nodiscard]] Table flow_symplecticity_table(const std::vector<MappedStates>& systems);

}  // namespace dmocbench
