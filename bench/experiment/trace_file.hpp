#pragma once

#include <vector>

#include "bench/experiment/table.hpp"
#include "methods/solvers/minor_iteration.hpp"

namespace dmocbench {

/// A row per minor iteration: major,phase,entering,leaving,into_basis,step,infeasibility,objective,superbasics,
/// basic_slacks. Columns are named x3 (variable 3 of the program, from 0) or s5 (the slack of row 5); the objective is
/// that of the quadratic program (scaled).
[[nodiscard]] Table trace_table(const std::vector<MinorIteration>& trace, Eigen::Index variables);

}  // namespace dmocbench
