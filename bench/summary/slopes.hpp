#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/experiment/table.hpp"

namespace dmocbench {

/// Numbers of intervals between which a slope is fitted.
struct FitRange {
  long long coarsest = 0;
  long long finest = 0;
};

/// Stands for a number of intervals where errors are measured against an exact solution.
constexpr long long exact_reference = -1;

/// Fitted slopes, and what a reader should know about them.
struct SlopeTable {
  /// problem,method,tableau,stages,quantity,slope,standard_error,finest,coarsest,points; finest and coarsest are
  /// numbers of intervals, quantities are the columns of errors without "_error".
  Table table;
  std::vector<std::string> notes;
};

/// Slopes of log(error) over log(step) for every curve and every error of a convergence table.
///
/// Without a range, grids from N = 32 (64 with more than one stage: the start of the asymptotic range on the two-link)
/// to a quarter of the reference are taken: against a reference of N_ref intervals an error of order 2 is proportional
/// to h² - h_ref², which bends the slope of finer grids; a range that goes beyond gets a note. `reference` is the
/// reference's number of intervals, 0 for the finest grid of a curve; `exact_reference` bends nothing, and grids are
/// taken up to the finest one, or to where an error reaches rounding or begins to fall at less than two thirds of its
/// order before: there it is the solver's tolerance. Errors at the level of rounding are left out.
[[nodiscard]] SlopeTable fit_slopes(const Table& convergence, const std::optional<FitRange>& range,
                                    long long reference);

}  // namespace dmocbench
