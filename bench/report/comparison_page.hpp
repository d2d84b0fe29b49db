#pragma once

#include <string>

#include "bench/report/results_folder.hpp"

namespace dmocbench {

/// A results folder and its name on the page.
struct ComparedRun {
  std::string name;
  ResultsFolder results;
};

/// Two results folders side by side as one self-contained page of HTML: claims whose verdict changed, times
/// with their intervals, counts and statuses that differ, and items that only one of them has.
[[nodiscard]] std::string comparison_page(const ComparedRun& first, const ComparedRun& second);

}  // namespace dmocbench
