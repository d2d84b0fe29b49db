#pragma once

#include "bench/tables/ratio_interval.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// The number of a row's cold starts that a column counts. Throws `Error` if the row is not about cold starts, has no
/// starts, or if the count exceeds their number or is not an integer.
[[nodiscard]] ShareCount count_of_cold_starts(const Row& row, const char* column);

}  // namespace dmocbench
