#pragma once

#include <string>
#include <vector>

#include "bench/tables/selection.hpp"

namespace dmocbench {

/// The measures that profiles are drawn of: columns of the rows.
[[nodiscard]] const std::vector<std::string>& profile_measures();

/// Performance profiles of Dolan and Moré (2002).
///
/// An instance is a problem on a number of intervals, a competitor a method with its tableau, solver and derivatives.
/// `share` is the share of all instances on which the competitor takes at most `ratio` times the effort of the best
/// one. A row whose `success` is not "yes" counts as infinite and stays in the denominator, so curves end below 1 where
/// something failed. Points: every ratio at which a curve steps, and both ends. An unsolved instance counts
/// as well.
[[nodiscard]] Table performance_profiles(const Selection& rows);

/// The effort of a competitor over all instances: per measure its shifted geometric mean exp(mean log(x + shift)) -
/// shift over the `common` instances, those that all competitors solved (the shift is the median of the measure over
/// those; empty where a solver does not report the measure), and `wins_` per measure: on how many instances it is the
/// best or as good.
[[nodiscard]] Table profile_summary(const Selection& rows);

/// The origin of a reference's cost, as in the column `reference_kind`.
inline constexpr const char* stated_reference = "stated by the problem";
inline constexpr const char* best_found_reference = "best found by any method here";

/// The rows, with a reference for problems without a stated one: the lowest cost of their solved rows on the finest
/// grid with solved rows. `reference_objective`, `reference_kind`, `objective_error` and `success` follow from it;
/// success is a solve within `tolerance` of it, relative. Problems without solved rows are unchanged.
[[nodiscard]] Table with_best_found_references(const Table& rows, double tolerance);

/// The costs that every method reaches on every problem, at the finest grid of the rows, in their order.
///
/// `relative_difference` is (objective - reference_objective) / |reference_objective|, with its sign: a minimum is
/// approached from either side, and one that lies lower by more than its discretisation can is a better one. A solve
/// that failed keeps its line with status and message, and the objective of the point where it ended.
[[nodiscard]] Table library_table(const Selection& rows);

/// The same for a reader: a Markdown table for every tableau, number of stages and solver, a line per problem and a
/// column per method; a failed solve shows its status, and a solved one whose `success` is "no" is marked "elsewhere".
/// Below each how many problems all methods solved, and how many they all solved with success. Takes
/// the result of `library_table`.
[[nodiscard]] std::string library_table_in_markdown(const Selection& library);

}  // namespace dmocbench
