#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/report/results_folder.hpp"

namespace dmocbench {

/// A results folder as one self-contained page of HTML: no files, no network, and JavaScript only to filter,
/// sort and play. `folder` is the path from the page's folder to the results, for downloads; empty where they are the
/// same.
[[nodiscard]] std::string report_page(const ResultsFolder& results, const std::string& folder);

/// A page of sections, which are HTML, by the titles that lead to them; empty ones are left out. A section's id is its
/// title in small letters.
[[nodiscard]] std::string page_of(const std::string& title,
                                  const std::vector<std::pair<std::string, std::string>>& sections);

}  // namespace dmocbench
