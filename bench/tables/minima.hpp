#pragma once

#include "bench/tables/selection.hpp"

namespace dmocbench {

/// The distinct minima that many starts of a problem ended in:
/// problem,tableau,stages,solver,derivatives,intervals,minimum,objective,is_best,is_motion,replay_confirmed, then a
/// column per method with how often it ended there.
///
/// Answers are the same minimum if their objectives differ from the lowest of them by less than `separation`, relative
/// to it, and the grid errors of both: the differences between `objective` and `interval_cost`. So costs that methods
/// have on one grid are compared at the accuracy that the grid allows. `minimum` counts from the lowest cost upwards.
/// It is a motion if the intervals of some answer, replayed one by one, join (`largest_jump_of_a_motion`), and the best
/// is the lowest that is on the finest grid; on a coarser grid it is the minimum whose cost is nearest to that one's.
/// `replay_confirmed` is a second opinion that cannot judge unstable systems: whether the replay of the whole horizon
/// ends near the final state for some answer. Rows that were not solved are in no minimum.
[[nodiscard]] Table distinct_minima(const Selection& rows, double separation);

/// The shares of starts by which each method found the best minimum.
[[nodiscard]] Table best_minimum_shares(const Selection& rows, double separation);

/// The minimum, of `distinct_minima`, in which each start of a plane of them ended.
[[nodiscard]] Table basins(const Selection& rows, double separation);

/// The largest error of a replay of the whole horizon that ends near the final state.
inline constexpr double confirmed_replay = 0.3;

}  // namespace dmocbench
