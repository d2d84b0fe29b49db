#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "bench/run/solve_case.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// Truncated modified energies along unforced motions by the midpoint rule in every family of elements.
struct ModifiedEnergyTables {
  Table drifts;  ///< a row per system, method, step and order of truncation; columns are declared in the source
  Table orders;  ///< fitted orders of the drift
};
[[nodiscard]] ModifiedEnergyTables modified_energy_tables();

/// Energy and virtual work of the forces along optimal motions, by the midpoint rule in every family of elements.
struct EnergyWorkTables {
  std::ptrdiff_t unsolved = 0;  ///< rows of `plain`, with reasons, whose motion was not solved on the common branch
  Table plain;                  ///< the energy itself, a row per problem, method and grid
  Table modified;               ///< the truncated modified energies, a row per order of truncation too
  Table orders;                 ///< fitted orders of the gaps of both, where solver and rounding leave less
};
/// Throws `Error` if the Lagrangian of a problem depends on time.
[[nodiscard]] EnergyWorkTables energy_work_tables(const std::vector<std::shared_ptr<const Problem>>& problems,
                                                  const SolverOptions& options);

}  // namespace dmocbench
