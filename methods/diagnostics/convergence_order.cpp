#include "methods/diagnostics/convergence_order.hpp"

#include <algorithm>
#include <cmath>

namespace dmocbench {

std::optional<FittedOrder> fit_order(const std::vector<GridError>& points) {
  std::vector<GridError> usable;
  std::copy_if(points.begin(), points.end(), std::back_inserter(usable), [](const GridError& point) {
    return point.step > 0.0 && point.error > 0.0 && std::isfinite(point.step) && std::isfinite(point.error);
  });
  if (usable.size() < 2) return std::nullopt;
  const auto count = static_cast<double>(usable.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (const GridError& point : usable) {
    mean_x += std::log(point.step) / count;
    mean_y += std::log(point.error) / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (const GridError& point : usable) {
    const double x = std::log(point.step) - mean_x;
    xx += x * x;
    xy += x * (std::log(point.error) - mean_y);
  }
  if (!(xx > 0.0)) return std::nullopt;
  FittedOrder order;
  order.slope = xy / xx;
  order.points = static_cast<int>(usable.size());
  double squares = 0.0;
  for (const GridError& point : usable) {
    const double residual = std::log(point.error) - mean_y - order.slope * (std::log(point.step) - mean_x);
    squares += residual * residual;
  }
  if (order.points > 2) order.standard_error = std::sqrt(squares / (count - 2.0) / xx);
  const auto [finest, coarsest] = std::minmax_element(
      usable.begin(), usable.end(), [](const GridError& a, const GridError& b) { return a.step < b.step; });
  order.finest = finest->step;
  order.coarsest = coarsest->step;
  return order;
}

}  // namespace dmocbench
