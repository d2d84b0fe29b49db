#pragma once

#include "bench/experiment/table.hpp"

namespace dmocbench {

/// What collocation costs beside DMOC in every currency of an iterations table:
/// problem,method,tableau,stages,intervals,currency,ratio_at_equal_intervals,ratio_at_equal_accuracy.
///
/// A currency is a column of the rows of one solver and one kind of start. At equal accuracy the cost of collocation on
/// N intervals stands beside what DMOC costs where its replay error is the same (straight lines in logarithms between
/// its grids; empty outside of them). Rows that were not solved, or lie on another branch, are left out.
[[nodiscard]] Table currency_ratios(const Table& iterations);

}  // namespace dmocbench
