#pragma once

#include <string>
#include <vector>

#include "bench/summary/selection.hpp"

namespace dmocbench {

/// The measures that profiles are drawn of: columns of the rows.
[[nodiscard]] const std::vector<std::string>& profile_measures();

/// Performance profiles of Dolan and Moré (2002): measure,method,tableau,stages,solver,derivatives,ratio,share.
///
/// An instance is a problem on a number of intervals, a competitor a method with its tableau, solver and derivatives.
/// `share` is the share of all instances on which the competitor takes at most `ratio` times what the best one takes. A
/// row whose `success` is not "yes" counts as infinite and stays in the denominator, so curves end below 1 where
/// something failed. Points: every ratio at which a curve steps, and both ends. An instance that nobody solves counts
/// as well.
[[nodiscard]] Table performance_profiles(const Selection& rows);

/// What a competitor takes over all instances: method,tableau,stages,solver,derivatives,instances,successes, then per
/// measure its shifted geometric mean exp(mean log(x + shift)) - shift over the `common` instances, those that all
/// competitors solved (the shift is the median of the measure over those; empty where a solver does not tell the
/// measure), and `wins_` per measure: on how many instances it is the best or as good.
[[nodiscard]] Table profile_summary(const Selection& rows);

}  // namespace dmocbench
