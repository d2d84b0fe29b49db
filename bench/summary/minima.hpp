#pragma once

#include "bench/summary/selection.hpp"

namespace dmocbench {

/// The distinct minima that many starts of a problem ended in:
/// problem,tableau,stages,solver,derivatives,intervals,minimum,objective,is_best,replay_confirmed, then a column per
/// method with how often it ended there.
///
/// Answers are the same minimum if their objectives differ from the lowest of them by less than `separation`, relative
/// to it: discretisations differ by less, minima by more. `minimum` counts from the lowest cost upwards; one is
/// confirmed if some method's motion there has a replay error below `confirmed_replay`, and the best is the lowest that
/// is. Rows that were not solved are in no minimum.
[[nodiscard]] Table distinct_minima(const Selection& rows, double separation, double confirmed_replay);

/// How often each method found the best minimum: problem,method,tableau,stages,solver,derivatives,intervals,starts,
/// solved,unsolved,unconfirmed,best,share,share_lower,share_upper. `unconfirmed` counts answers in minima that no
/// replay confirms. The interval is Wilson's, 95 %.
[[nodiscard]] Table best_minimum_shares(const Selection& rows, double separation, double confirmed_replay);

}  // namespace dmocbench
