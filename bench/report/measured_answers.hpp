#pragma once

#include <string>

#include "bench/report/results_folder.hpp"

namespace dmocbench {

/// Results of the tables of a folder without judged claims: a line per problem, method and scheme with the orders that
/// were fitted, each with its standard error, and how many solves were solved. Empty where no table has either.
[[nodiscard]] std::string measured_answers_html(const ResultsFolder& results);

}  // namespace dmocbench
