#pragma once

#include <string>
#include <utility>

#include "bench/report/results_folder.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// Five questions about the methods, each answered in a sentence by the claims that a run has judged, with the
/// measurements for each problem and the verdicts; empty if these claims were not judged.
[[nodiscard]] std::string answers_html(const ResultsFolder& results);

/// A verdict as a small label.
[[nodiscard]] std::string badge(const std::string& verdict);

/// The first place in the paper that a claim names, such as "section 4.2.1".
[[nodiscard]] std::string section_of(const Row& claim);

/// "orbital_transfer" and "state_slope" of "orbital_transfer/state_slope".
[[nodiscard]] std::pair<std::string, std::string> problem_and_name(const std::string& claim);

}  // namespace dmocbench
