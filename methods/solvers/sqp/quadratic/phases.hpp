#pragma once

#include <functional>

#include "methods/solvers/minor_iteration.hpp"
#include "methods/solvers/sqp/quadratic/iterate.hpp"
#include "methods/solvers/sqp/quadratic/pricing.hpp"
#include "methods/solvers/sqp/quadratic/reduced_hessian.hpp"

namespace dmocbench::sqp {

/// Told of every minor iteration as it ends; false stops the method. The count of minor iterations is the number of
/// calls.
using MinorObserver = std::function<bool(const MinorIteration&)>;

/// Thrown where an observer asks to stop.
struct Stopped {};

/// Phase 1: one column enters the basis and one leaves per minor iteration, so that the sum of infeasibilities falls,
/// until all columns are within their bounds or no column can lower the sum. Throws `Breakdown`, `Stopped`.
void find_feasible_point(Iterate& iterate, Pricing& pricing, double tolerance, const MinorObserver& observer);

/// Phase 2: from a feasible point (up to violations that were accepted) to the minimiser. A column whose reduced
/// gradient exceeds `tolerance` becomes superbasic when the point is stationary on the present sets; each minor
/// iteration takes the exact step of the reduced Hessian `reduced` = ZᵀHZ (which belongs to the superbasic columns at
/// the start), or as much of it as the bounds allow. Returns the multipliers π of A d - s = 0: g + Hd - Aᵀπ vanishes in
/// the free columns. Throws `Breakdown`, `Stopped`.
[[nodiscard]] Eigen::VectorXd find_minimiser(Iterate& iterate, ReducedHessian& reduced, Pricing& pricing,
                                             double tolerance, const MinorObserver& observer);

/// The columns that are neither basic nor (if `but_superbasics`) superbasic, may move, and lower the objective by it:
/// `rates` (n + m entries) are the rates of change of the objective.
[[nodiscard]] std::vector<PricedColumn> candidates_of(const Iterate& iterate, const Eigen::VectorXd& rates,
                                                      double tolerance, bool but_superbasics);

/// Tells the observer; throws `Stopped`.
void report(const Iterate& iterate, MinorIteration minor, const MinorObserver& observer);

}  // namespace dmocbench::sqp
