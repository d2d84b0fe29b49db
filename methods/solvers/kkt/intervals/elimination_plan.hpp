#pragma once

#include <optional>

#include "methods/solvers/kkt/intervals/interval_entries.hpp"
#include "methods/solvers/kkt/intervals/segment_kernel.hpp"

namespace dmocbench::kkt {

/// Chooses which unknowns the equalities of an interval determine, and in which order, by Gaussian elimination with
/// complete pivoting on one interval's numbers; every interval follows this order without exchanges, and measures its
/// pivots by those found here. None if the equalities of that interval depend on each other.
[[nodiscard]] std::optional<EliminationPlan> elimination_plan(const IntervalEntries& entries,
                                                              const NewtonArrays& arrays, Eigen::Index interval);

}  // namespace dmocbench::kkt
