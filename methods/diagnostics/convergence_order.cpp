#include "methods/diagnostics/convergence_order.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace dmocbench {

std::optional<FittedOrder> fit_order(const std::vector<GridError>& points) {
  std::vector<GridError> usable;
  std::ranges::copy_if(points, std::back_inserter(usable), [](const GridError& point) {
    return point.step > 0.0 && point.error > 0.0 && std::isfinite(point.step) && std::isfinite(point.error);
  });
  const auto count = static_cast<Eigen::Index>(usable.size());
  if (count < 2) return std::nullopt;
  Eigen::ArrayXd x(count);
  Eigen::ArrayXd y(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    x[i] = std::log(usable[static_cast<std::size_t>(i)].step);
    y[i] = std::log(usable[static_cast<std::size_t>(i)].error);
  }
  x -= x.mean();
  y -= y.mean();
  const double xx = x.square().sum();
  if (!(xx > 0.0)) return std::nullopt;
  FittedOrder order;
  order.order = (x * y).sum() / xx;
  order.points = static_cast<int>(count);
  const double squares = (y - order.order * x).square().sum();
  if (count > 2) order.standard_error = std::sqrt(squares / static_cast<double>(count - 2) / xx);
  const auto [finest, coarsest] = std::ranges::minmax_element(usable, {}, &GridError::step);
  order.first_abscissa = finest->step;
  order.last_abscissa = coarsest->step;
  return order;
}

}  // namespace dmocbench
