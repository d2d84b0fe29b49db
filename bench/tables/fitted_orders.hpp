#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/tables/selection.hpp"

namespace dmocbench {

/// Numbers of intervals between which an order is fitted.
struct FitRange {
  long long coarsest = 0;
  long long finest = 0;
};

/// Stands for a number of intervals where errors are measured against an exact solution.
constexpr long long exact_reference = -1;

/// Fitted orders of convergence, with notes for the reader.
struct FittedOrders {
  /// `verdict` is "slope", "floor" where too few grids lie above the floor (such a row has no order), or "few grids"
  /// where there are too few of them anyway.
  Table table;
  std::vector<std::string> notes;
};

/// Orders, the slopes of log(error) over log(step), for every curve and every error of a convergence table.
///
/// Against a finer grid: without a range, grids from N = 32 (64 with more than one stage) to a quarter of the reference
/// are used. Against a reference of N_ref intervals an error of order 2 is proportional to h² - h_ref², which makes the
/// order of finer grids too large; a range that goes beyond gets a note, as does a curve without any order. Errors at
/// the level of rounding are left out. `reference` is the reference's number of intervals, 0 for the finest grid of a
/// curve.
///
/// Against an `exact_reference` grids are used from the start of the asymptotic range (`asymptotic_from`) as long as
/// the error is above 100 times the floor, and there must be four of them. The floor is measured: it is the median of
/// the errors on a curve's finest grids where they fall with less than half the order seen before; the smallest floor
/// among the curves of a problem and method holds for all of them. With a range, every error in it is used.
[[nodiscard]] FittedOrders fit_orders(const Selection& convergence, const std::optional<FitRange>& range,
                                      long long reference);

/// How the worst interval (`accuracy`, which needs no other solution) tells the true error: a row per curve of a
/// convergence table against an exact reference.
///
/// Both slopes, of `largest_jump` and of the state error, are fitted on the same grids: those where both are above
/// their floors by the rules of `fit_orders`.
/// `error_of_jumps` is the state error divided by N times the jump:
/// it does not depend on N where the slopes are one order apart, because an error is the sum of N jumps that the motion
/// carries on. With one stage they are. With s > 1 the order of the error is 2s and that of the jumps lies between
/// s + 2, of the stage controls, and 2s + 1.
[[nodiscard]] Table fit_jumps(const Selection& convergence);

/// Orders of a column of differences from DMOC (a table of `equivalence`) for every curve of
/// tangent-space collocation, in the columns and by the rules of an exact reference. The floor is the largest such
/// difference of Hamiltonian collocation on the same problem, which by (th:equi) is rounding.
[[nodiscard]] Table fit_differences(const Selection& equivalence, const std::string& column);

}  // namespace dmocbench
