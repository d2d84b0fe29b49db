#pragma once

#include <string>

#include "bench/report/results_folder.hpp"

namespace dmocbench {

/// The parts of the page, each a <section>, or empty.
/// The extent of the comparison, the answer in five sentences, machine, date, and the unsolved cases.
[[nodiscard]] std::string overview_section(const ResultsFolder& results);
/// All claims with their verdicts and their evidence.
[[nodiscard]] std::string claims_section(const ResultsFolder& results);
/// Every problem of the program: its motions, its statement, its optimum and the methods that reach it; empty if no
/// motion was written.
[[nodiscard]] std::string gallery_section(const ResultsFolder& results);
/// Every figure, as an image in the page.
[[nodiscard]] std::string figures_section(const ResultsFolder& results);
/// Every table: columns that differ between rows, as many rows as `most_rows`; `folder` as `report_page`.
[[nodiscard]] std::string tables_section(const ResultsFolder& results, const std::string& folder);

/// Rows of a table in the page; the others are in its file.
inline constexpr std::size_t most_rows = 60;

}  // namespace dmocbench
