#pragma once

#include <vector>

#include "methods/kkt/intervals/interval_entries.hpp"
#include "methods/kkt/intervals/pass_kernel.hpp"

namespace dmocbench::kkt {

/// The sums of entries of the program that make up each number of `PassInputBlocks`.
[[nodiscard]] std::vector<PassGather> pass_gathers(const IntervalEntries& entries, const EliminationPlan& plan);

/// The slots of `PassInputBlocks::form` on the diagonal of fixed unknowns of an interval.
[[nodiscard]] std::vector<int> pass_units(const IntervalEntries& entries);

/// The place of each equality in the order of elimination.
[[nodiscard]] std::vector<int> places_of_rows(const EliminationPlan& plan);

}  // namespace dmocbench::kkt
