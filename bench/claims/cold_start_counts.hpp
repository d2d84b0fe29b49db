#pragma once

#include "bench/tables/share_interval.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// How many of the cold starts of a row are counted in a column. Throws `Error` if the row is not about cold starts,
/// has none, or counts more than there were or parts of one.
[[nodiscard]] ShareCount count_of_cold_starts(const Row& row, const char* column);

}  // namespace dmocbench
