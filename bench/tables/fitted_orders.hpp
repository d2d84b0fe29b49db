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

/// The fewest grids for an order in such a range.
constexpr long long fewest_in_range = 3;

/// Stands for a number of intervals where errors are measured against an exact solution.
constexpr long long exact_reference = -1;

/// Fitted orders of convergence, with notes for the reader.
struct FittedOrders {
  /// `verdict` is "slope", or the reason why there is no order: "floor" where too few grids lie above the floor, "few
  /// grids" where there are too few of them anyway, "unsteady" where no four neighbouring grids agree.
  Table table;
  std::vector<std::string> notes;
};

/// Orders, the slopes of log(error) over log(step), for every curve and every error of a convergence table.
///
/// They are fitted on the asymptotic range (`asymptotic_range`) of the grids whose error is above 100 times the floor.
/// The floor is measured: it is the median of the errors on a curve's finest grids where they fall with less than order
/// 1/2 on the whole; the smallest floor among the curves of a problem and method holds for all of them. With a
/// range of the user's every error in it is used, at least `fewest_in_range`, except for those at the level of
/// rounding.
///
/// `reference` is the number of intervals of the reference, 0 for the finest usable grid of a curve, or
/// `exact_reference`. A note states where the grid that was meant is not usable, and why.
/// Against a grid of step r an error of order p is proportional to h^p - r^p, which the fit takes into account.
[[nodiscard]] FittedOrders fit_orders(const Selection& convergence, const std::optional<FitRange>& range,
                                      long long reference);

/// Prediction of the true error by the worst interval (`accuracy`, which needs no other solution): a row per curve of a
/// convergence table against an exact reference.
///
/// Both slopes, of `largest_jump` and of the state error, are fitted on the same grids, where both are above
/// their floors by the rules of `fit_orders`.
/// `error_of_jumps` is the state error divided by N times the jump:
/// it does not depend on N where the slopes are one order apart, because an error is the sum of N jumps that the motion
/// carries on. With one stage they are. With s > 1 the order of the error is 2s and the order of the jumps lies between
/// s + 2, of the stage controls, and 2s + 1.
[[nodiscard]] Table fit_jumps(const Selection& convergence);

/// Orders of a column of differences from DMOC (a table of `equivalence`) for every curve of
/// tangent-space collocation, in the columns and by the rules of an exact reference. The floor is the largest such
/// difference of Hamiltonian collocation on the same problem, which by (th:equi) is rounding.
[[nodiscard]] Table fit_differences(const Selection& equivalence, const std::string& column);

/// Whether a row of `equivalence` has the solution of DMOC: each of the two satisfies the equations of the other method
/// to round-off, or to 1e-10 where round-off is smaller. Throws `Error` if a residual is missing.
[[nodiscard]] bool has_solution_of_dmoc(const Row& row);

}  // namespace dmocbench
