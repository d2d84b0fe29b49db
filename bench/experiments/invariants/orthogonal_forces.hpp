#pragma once

#include "methods/solvers/solver.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// Optimal control problems whose forces are orthogonal to a symmetry of L ("Preservation of momentum maps", section
/// 3.3): how far the momentum moves along the optimal motions of every method. A row per problem, method, tableau and
/// grid; columns are declared in the source. Throws `Error` if a motion is not solved.
[[nodiscard]] Table orthogonal_forces_table(const SolverOptions& options);

}  // namespace dmocbench
