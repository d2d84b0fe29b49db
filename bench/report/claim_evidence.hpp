#pragma once

#include <string>

#include "bench/report/results_folder.hpp"

namespace dmocbench {

/// The evidence for a claim, as terms of a list of HTML: its files as links to where the page shows them, the rows
/// and columns of tables by which it was judged, and the commands that make it again.
[[nodiscard]] std::string claim_evidence(const Row& claim, const ResultsFolder& results);

/// Rows that a claim shows of a table; if there are more they are chosen evenly, the first and the last among them.
inline constexpr std::size_t most_rows_of_claim = 24;

}  // namespace dmocbench
