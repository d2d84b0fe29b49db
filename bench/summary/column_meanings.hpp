#pragma once

#include <map>
#include <string>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// What the columns of summaries mean, by their names, for `explain`; units stand in brackets. Columns that a
/// summary takes over from the rows that it sums up are explained there.
using ColumnMeanings = std::map<std::string, std::string>;

/// Of `fit_orders`, `fit_differences` and `fit_jumps`.
[[nodiscard]] const ColumnMeanings& meanings_in_orders();
/// Of `equal_accuracy`, `currency_ratios` and `advantage_ratios`.
[[nodiscard]] const ColumnMeanings& meanings_in_ratios();
/// Of `cold_start_shares` and `cold_start_profiles`.
[[nodiscard]] const ColumnMeanings& meanings_in_cold_starts();
/// Of `distinct_minima` and `best_minimum_shares`; the columns of methods are not among them.
[[nodiscard]] const ColumnMeanings& meanings_in_minima();
/// Of `performance_profiles`, `profile_summary` and `library_table`.
[[nodiscard]] const ColumnMeanings& meanings_in_profiles();

/// Tells a table what its columns mean and what they hold: a text, a whole number, or else a number.
void explain(Table& table, const ColumnMeanings& meanings);

}  // namespace dmocbench
