#pragma once

#include "methods/tables/table.hpp"

namespace dmocbench {

/// The forced discrete Noether theorem (eq:noether_force_d) for a group that is not abelian: rotations of space, one
/// generator about each of three axes. `steps` steps of the one-step map by the midpoint rule under arbitrary forces.
///
/// Where rotations act linearly on the coordinates the discrete Lagrangian is invariant too, and the theorem applies;
/// in polar coordinates on the sphere it is invariant about the third axis alone. A row per system, method and axis;
/// columns are declared in the source.
[[nodiscard]] Table rotations_table(int steps);

}  // namespace dmocbench
