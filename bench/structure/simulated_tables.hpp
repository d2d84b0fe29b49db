#pragma once

#include "methods/tables/table.hpp"

namespace dmocbench {

/// The forced discrete Noether theorem (th:discforcNoe, eq:noether_force_d): `steps` steps of the one-step map under
/// arbitrary stage controls. A row per system with a symmetry, method and tableau; the columns are declared in the
/// source.
[[nodiscard]] Table noether_table(int steps);

/// The unforced one-step map's |DᵀΩD - Ω|, the largest over some states. A row per system, method and tableau.
[[nodiscard]] Table symplecticity_table();

}  // namespace dmocbench
