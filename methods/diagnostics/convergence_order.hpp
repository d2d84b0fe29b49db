#pragma once

#include <optional>
#include <vector>

namespace dmocbench {

/// A grid's step (or number of intervals) and the error measured on it.
struct GridError {
  double step = 0.0;   ///< h
  double error = 0.0;  ///< at this step
};

/// A straight line through log(error) over log(step).
struct FittedOrder {
  double order = 0.0;           ///< the exponent of h
  double standard_error = 0.0;  ///< of the order; 0 with two points
  double first_abscissa = 0.0;  ///< the smallest step used
  double last_abscissa = 0.0;   ///< the largest step used
  int points = 0;               ///< how many it was fitted through
};

/// The order by least squares: the slope of log(error) over log(step). Points whose error is not positive and finite
/// are left out; nothing is returned if fewer than two points remain.
[[nodiscard]] std::optional<FittedOrder> fit_order(const std::vector<GridError>& points);

}  // namespace dmocbench
