#pragma once

#include "bench/summary/selection.hpp"

namespace dmocbench {

/// What the same accuracy costs each method, from a convergence table:
/// problem,tableau,stages,quantity,error,method,intervals,variables,seconds,variables_ratio,seconds_ratio.
///
/// For errors 10^-k/2 that every method of a problem and tableau reaches within its grids, the number of intervals, of
/// free variables and the seconds of a solve are read off the method's curve (straight lines in logarithms between
/// grids). Ratios are to dmoc, where it is there.
[[nodiscard]] Table equal_accuracy(const Selection& convergence);

}  // namespace dmocbench
