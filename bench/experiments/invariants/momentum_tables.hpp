#pragma once

#include "methods/solvers/solver.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// The forced discrete Noether theorem (eq:noether_force_d) for a group that is not abelian: rotations of space, one
/// generator about each of three axes. `steps` steps of the one-step map by the midpoint rule under arbitrary forces.
///
/// Where rotations act linearly on the coordinates the discrete Lagrangian is invariant too, and the theorem applies;
/// in polar coordinates on the sphere it is invariant about the third axis alone. A row per system, method and axis;
/// columns are declared in the source.
[[nodiscard]] Table rotations_table(int steps);

/// Optimal control problems whose forces are orthogonal to a symmetry of L ("Preservation of momentum maps", section
/// 3.3): how far the momentum moves along the optimal motions of every method. A row per problem, method, tableau and
/// grid; columns are declared in the source. Throws `Error` if a motion is not solved.
[[nodiscard]] Table orthogonal_forces_table(const SolverOptions& options);

}  // namespace dmocbench
