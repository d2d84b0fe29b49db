#include "methods/solvers/sqp/quadratic/ratio_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmocbench::sqp {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
/// Rates below this share of the largest one are rounding.
constexpr double smallest_rate = 1e-11;

/// The bound that the column moves towards and must not pass; infinite if there is none.
double bound_ahead(const MovingColumn& column, double tolerance) {
  if (column.rate > 0.0) {
    if (column.value < column.lower - tolerance) return column.lower;
    if (column.value > column.upper + tolerance) return never;
    return column.upper;
  }
  if (column.value > column.upper + tolerance) return column.upper;
  if (column.value < column.lower - tolerance) return -never;
  return column.lower;
}

/// The step at which it is reached if `slack` beyond it is allowed.
double step_to_bound(const MovingColumn& column, double tolerance, double slack) {
  const double bound = bound_ahead(column, tolerance);
  if (std::isinf(bound)) return never;
  const double distance = column.rate > 0.0 ? bound - column.value : column.value - bound;
  return std::max(0.0, (distance + slack) / std::abs(column.rate));
}

}  // namespace

RatioTest ratio_test(const std::vector<MovingColumn>& columns, double limit, double tolerance) {
  double largest = 0.0;
  for (const MovingColumn& column : columns) largest = std::max(largest, std::abs(column.rate));
  const auto moves = [&](const MovingColumn& column) { return std::abs(column.rate) > smallest_rate * largest; };

  double relaxed = limit;
  for (const MovingColumn& column : columns) {
    if (moves(column)) relaxed = std::min(relaxed, step_to_bound(column, tolerance, tolerance));
  }
  RatioTest result{.step = limit, .blocking = {}};
  double best_rate = 0.0;
  for (std::size_t place = 0; place < columns.size(); ++place) {
    const MovingColumn& column = columns[place];
    if (!moves(column)) continue;
    const double step = step_to_bound(column, tolerance, 0.0);
    if (step <= relaxed && step < limit && std::abs(column.rate) > best_rate) {
      best_rate = std::abs(column.rate);
      result = {.step = step, .blocking = place};
    }
  }
  return result;
}

}  // namespace dmocbench::sqp
