#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "methods/kkt/intervals/interval_entries.hpp"
#include "methods/kkt/intervals/segment_kernel.hpp"

namespace dmocbench::kkt {

/// Chooses which unknowns the equalities of an interval determine, and in which order, by Gaussian elimination with
/// complete pivoting on the numbers of some `intervals`, at least one, so that the pivot of the interval where it is
/// smallest is as large as it can be. Every interval follows this order without exchanges, and measures its pivots by
/// the pivots of the first of `intervals`. None if the equalities of one of them depend on each other.
[[nodiscard]] std::optional<EliminationPlan> elimination_plan(const IntervalEntries& entries,
                                                              const NewtonArrays& arrays,
                                                              const std::vector<Eigen::Index>& intervals);

}  // namespace dmocbench::kkt
