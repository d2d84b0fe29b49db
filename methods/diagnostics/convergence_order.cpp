#include "methods/diagnostics/convergence_order.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <Eigen/Core>

namespace dmocbench {

namespace {

/// The slope of y over x by least squares, and its residual.
FittedOrder fitted_line(Eigen::ArrayXd x, Eigen::ArrayXd y) {
  x -= x.mean();
  y -= y.mean();
  const double xx = x.square().sum();
  FittedOrder line{.order = (x * y).sum() / xx, .points = static_cast<int>(x.size())};
  const double squares = (y - line.order * x).square().sum();
  if (line.points > 2) line.standard_error = std::sqrt(squares / static_cast<double>(line.points - 2) / xx);
  return line;
}

}  // namespace

std::optional<FittedOrder> fit_order(const std::vector<GridError>& points, double reference) {
  std::vector<GridError> usable;
  std::ranges::copy_if(points, std::back_inserter(usable), [&](const GridError& point) {
    return point.step > reference && point.error > 0.0 && std::isfinite(point.step) && std::isfinite(point.error);
  });
  const auto [finest, coarsest] = std::ranges::minmax_element(usable, {}, &GridError::step);
  if (usable.size() < 2 || finest->step == coarsest->step) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(usable.size());
  Eigen::ArrayXd x(count);
  Eigen::ArrayXd y(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    x[i] = std::log(usable[static_cast<std::size_t>(i)].step);
    y[i] = std::log(usable[static_cast<std::size_t>(i)].error);
  }
  FittedOrder order = fitted_line(x, y);
  // log(h^p - r^p) = p log h + log(1 - (r/h)^p), whose last term depends little on p.
  constexpr int most_corrections = 50;
  constexpr double settled = 1e-12;
  for (int i = 0; reference > 0.0 && i < most_corrections; ++i) {
    const double before = order.order;
    const double p = std::max(before, 0.1);
    order = fitted_line(x, y - (1.0 - (p * (std::log(reference) - x)).exp()).log());
    if (std::abs(order.order - before) < settled) break;
  }
  order.first_abscissa = finest->step;
  order.last_abscissa = coarsest->step;
  return order;
}

std::vector<double> neighbouring_orders(const std::vector<GridError>& points, double reference) {
  std::vector<double> orders;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto order = fit_order({points[i - 1], points[i]}, reference);
    orders.push_back(order ? order->order : std::numeric_limits<double>::quiet_NaN());
  }
  return orders;
}

std::string_view name_of(RangeEnd end) noexcept {
  if (end == RangeEnd::floor) return "floor";
  return end == RangeEnd::orders ? "orders" : "grids";
}

std::optional<AsymptoticRange> asymptotic_range(const std::vector<GridError>& points, double least, double reference) {
  const auto at_floor = std::ranges::find_if(points, [&](const GridError& point) { return !(point.error > least); });
  const auto above = static_cast<std::size_t>(at_floor - points.begin());
  const std::vector<double> orders = neighbouring_orders(points, reference);
  for (std::size_t end = above; end >= fewest_grids; --end) {
    double lowest = orders[end - 2];
    double highest = lowest;
    std::size_t first = end - 1;
    while (first > 0 && std::isfinite(orders[first - 1])) {
      lowest = std::min(lowest, orders[first - 1]);
      highest = std::max(highest, orders[first - 1]);
      if (!(highest - lowest <= largest_spread)) break;
      --first;
    }
    if (end - first < fewest_grids) continue;
    AsymptoticRange range{.first = first, .end = end};
    if (first > 0) range.coarse_end = RangeEnd::orders;
    if (end < points.size()) range.fine_end = end < above ? RangeEnd::orders : RangeEnd::floor;
    return range;
  }
  return std::nullopt;
}

std::optional<FittedOrder> asymptotic_order(const std::vector<GridError>& points, double least) {
  const auto range = asymptotic_range(points, least);
  if (!range) return std::nullopt;
  return fit_order({points.data() + range->first, points.data() + range->end});
}

}  // namespace dmocbench
