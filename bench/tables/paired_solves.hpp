#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/tables/selection.hpp"
#include "bench/tables/share_interval.hpp"

namespace dmocbench {

/// Two solves of the same program from the same start.
struct SolvePair {
  std::reference_wrapper<const Row> first;
  std::reference_wrapper<const Row> second;
};

/// The rows of `first` beside those of `second` that have the same fields in the columns `key`, in the order of
/// `first`; rows without a counterpart are left out.
[[nodiscard]] std::vector<SolvePair> paired_solves(const Selection& first, const Selection& second,
                                                   const ColumnNames& key);

/// Whether the solver solved its program. An answer that is no motion since the grid is too coarse counts: that is not
/// the solver's.
[[nodiscard]] bool solves_program(const Row& row);

/// How many of the programs each of the two solved.
[[nodiscard]] PairedCount count_of(const std::vector<SolvePair>& pairs);

/// The pairs of which the second alone was solved.
[[nodiscard]] std::vector<SolvePair> lost_by_first(const std::vector<SolvePair>& pairs);

/// Iterations of the first over those of the second, sorted, of the pairs that both solved in at least one iteration.
[[nodiscard]] std::vector<double> iteration_ratios(const std::vector<SolvePair>& pairs);

}  // namespace dmocbench
