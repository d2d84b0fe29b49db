#pragma once

#include <string>

#include "bench/summary/selection.hpp"

namespace dmocbench {

/// What every method reaches on every problem, at the finest grid of the rows:
/// problem,reference_objective,reference_digits,method,tableau,stages,solver,derivatives,intervals,status,objective,
/// relative_difference,success,replay_error,message, in the order of the rows.
///
/// `relative_difference` is (objective - reference_objective) / |reference_objective|, with its sign: a minimum is
/// approached from either side, and one that lies lower by more than its discretisation can is a better one. A solve
/// that failed keeps its line with status and message, and the objective of the point where it ended.
[[nodiscard]] Table library_table(const Selection& rows);

/// The same for a reader: a Markdown table for every tableau, number of stages and solver, a line per problem and a
/// column per method; a failed solve shows its status, and a solved one whose `success` is "no" is marked "elsewhere".
/// Below each how many problems all methods solved, and how many they all solved with success. Takes what
/// `library_table` gives.
[[nodiscard]] std::string library_table_in_markdown(const Selection& library);

}  // namespace dmocbench
