#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/tables/ratio_interval.hpp"
#include "bench/tables/selection.hpp"

namespace dmocbench {

/// Error and cost of one grid.
struct ErrorCostPoint {
  double log_error = 0.0;  ///< decimal logarithm
  double cost = 0.0;
};

/// The cost of a row; empty if it is missing.
using Cost = std::function<std::optional<double>(const Row&)>;
/// The cost that stands in a column.
[[nodiscard]] Cost cost_in(const std::string& column);

/// The points of usable rows that have an error and a cost above zero, in the order of the rows.
[[nodiscard]] std::vector<ErrorCostPoint> error_cost_points(const Selection& rows, const std::string& error_column,
                                                            const Cost& cost);

/// The cost at which a curve reaches an error: the cost of the first point whose error has the same logarithm to within
/// `same_log_error`, else by straight lines in logarithms between the points; empty outside of them.
[[nodiscard]] std::optional<double> cost_at_error(const std::vector<ErrorCostPoint>& points, double error,
                                                  double same_log_error = 0.0);

/// The cost of a row relative to others on the same number of intervals, and where their error is the same.
struct CostRatios {
  std::optional<double> at_equal_intervals;
  std::optional<double> at_equal_accuracy = {};
};
[[nodiscard]] CostRatios cost_ratios(const Row& row, const Selection& others, const Cost& cost,
                                     const std::string& error_column, double same_log_error = 0.0);

/// A cost of a solve compared with DMOC's, as tables show it.
struct ComparedCost {
  Row head;
  std::string name;  ///< of the compared cost
  CostRatios ratios;
  MedianOfRounds rounds = {};  ///< of the ratio at equal intervals
};

/// The columns of a table of compared costs: the head's, `name`, and the ratios.
[[nodiscard]] Columns<ComparedCost> compared_cost_columns(const ColumnNames& of_head, const std::string& name,
                                                          const std::string& meaning);

/// The cost of equal accuracy by each method, from a convergence table.
///
/// Quantities are the errors of state and control, and the replay error. For errors 10^-k/2 that every method
/// reaches within its grids, by the same tableau, solver and derivatives, the number of intervals, of free variables
/// and the seconds of a solve are read off the method's curve (straight lines in logarithms between grids). Ratios are
/// to dmoc, if present.
[[nodiscard]] Table equal_accuracy(const Selection& convergence);

/// The cost of collocation compared with DMOC in every currency of an iterations table.
///
/// A currency is a column of the rows of one solver and one kind of start. Methods are compared with the same
/// derivatives and tolerance. Accuracy is the replay error. Rows that were not solved, or lie on another branch, are
/// left out.
[[nodiscard]] Table currency_ratios(const Selection& iterations);

/// The cost of collocation relative to DMOC, solver by solver, from a table of savings_by_solver.
///
/// Quantities are "seconds" of a solve, "seconds_per_iteration", the same without evaluations of the program
/// ("linear_algebra_per_iteration"), "seconds_per_linear_system" (without finding its structure; reported only by
/// interior_point), and "iterations".
///
/// At equal accuracy the cost on N intervals is compared with DMOC's cost at the same error of the objective (straight
/// lines in logarithms between its grids; empty outside of them).
///
/// Rows count if they were solved on the wanted branch and their objective agrees with every other solver's of the same
/// program to 1e-6.
[[nodiscard]] Table advantage_ratios(const Selection& advantage);

}  // namespace dmocbench
