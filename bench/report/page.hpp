#pragma once

#include <string>

#include "bench/report/results_folder.hpp"

namespace dmocbench {

/// A results folder as one page of HTML that needs nothing else: no file, no network, and JavaScript only to filter,
/// sort and play. `folder` is the path from the page's folder to the results, for downloads; empty where they are the
/// same.
[[nodiscard]] std::string report_page(const ResultsFolder& results, const std::string& folder);

}  // namespace dmocbench
