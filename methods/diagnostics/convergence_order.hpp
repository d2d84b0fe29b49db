#pragma once

#include <optional>
#include <vector>

namespace dmocbench {

/// A grid's step (or number of intervals) and the error measured on it.
struct GridError {
  double step = 0.0;
  double error = 0.0;
};

/// A straight line through log(error) over log(step).
struct FittedOrder {
  double slope = 0.0;           ///< the order
  double standard_error = 0.0;  ///< of the slope; 0 with two points
  double finest = 0.0;          ///< smallest step used
  double coarsest = 0.0;        ///< largest step used
  int points = 0;
};

/// Least-squares slope of log(error) over log(step). Points whose error is not positive and finite are left out; none
/// with fewer than two points left.
[[nodiscard]] std::optional<FittedOrder> fit_order(const std::vector<GridError>& points);

}  // namespace dmocbench
