#include "methods/solvers/sqp/quadratic/pricing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmocbench::sqp {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
/// Rates below this share of the largest one are rounding.
constexpr double smallest_rate = 1e-11;

/// The step at which the column reaches the bound ahead of it, if it may pass that by `slack`. One that is outside has
/// the bound that it violates ahead of it, or none if it moves away.
double step_to_bound(MovingColumn column, double tolerance, double slack) {
  if (column.rate < 0.0) column = {-column.value, -column.rate, -column.upper, -column.lower};
  if (column.value > column.upper + tolerance) return never;
  const double bound = column.value < column.lower - tolerance ? column.lower : column.upper;
  return std::max(0.0, (bound - column.value + slack) / column.rate);
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
  RatioTest result{.step = limit};
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
