#pragma once

#include <functional>

#include "methods/solvers/minor_iteration.hpp"
#include "methods/solvers/sqp/quadratic/iterate.hpp"
#include "methods/solvers/sqp/quadratic/pricing.hpp"

namespace dmocbench::sqp {

/// Called at the end of every minor iteration; false stops the method. The number of calls is the count of minor
/// iterations.
using MinorObserver = std::function<bool(const MinorIteration&)>;

/// Thrown where an observer asks to stop.
struct Stopped {};

/// Phase 1: one column enters the basis and one leaves per minor iteration, so that the sum of infeasibilities falls,
/// until all columns are within their bounds or no column can lower the sum. Throws `Breakdown`, `Stopped`.
void find_feasible_point(Iterate& iterate, Pricing& pricing, double tolerance, const MinorObserver& observer);

/// Phase 2: from a feasible point (up to violations that were accepted) to the minimiser. A column whose reduced
/// gradient exceeds `tolerance` becomes superbasic when the point is stationary on the present sets; each minor
/// iteration takes the exact step of the reduced Hessian ZᵀHZ, or as much of it as the bounds allow. Returns the
/// multipliers π of A d - s = 0: g + Hd - Aᵀπ vanishes in the free columns. Throws `Breakdown`, `Stopped`.
[[nodiscard]] Eigen::VectorXd find_minimiser(Iterate& iterate, Pricing& pricing, double tolerance,
                                             const MinorObserver& observer);

}  // namespace dmocbench::sqp
