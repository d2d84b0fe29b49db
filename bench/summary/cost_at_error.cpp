#include "bench/summary/cost_at_error.hpp"

#include <cmath>

#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

std::vector<ErrorCostPoint> error_cost_points(const std::vector<const Row*>& rows, const std::string& error_column,
                                              const std::string& cost_column) {
  std::vector<ErrorCostPoint> points;
  for (const Row* row : rows) {
    const auto error = row->number(error_column);
    const auto cost = row->number(cost_column);
    if (is_usable(*row) && error && cost && *error > 0.0 && *cost > 0.0) {
      points.push_back({std::log10(*error), std::log10(*cost)});
    }
  }
  return points;
}

std::optional<double> cost_at_error(const std::vector<ErrorCostPoint>& points, double error) {
  const double wanted = std::log10(error);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const ErrorCostPoint& a = points[i];
    const ErrorCostPoint& b = points[i + 1];
    if (wanted > a.error || wanted < b.error || a.error == b.error) continue;
    const double weight = (wanted - a.error) / (b.error - a.error);
    return std::pow(10.0, a.cost + weight * (b.cost - a.cost));
  }
  return std::nullopt;
}

}  // namespace dmocbench
