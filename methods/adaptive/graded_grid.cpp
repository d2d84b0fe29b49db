#include "methods/adaptive/graded_grid.hpp"

#include <algorithm>
#include <cmath>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// A positive function of τ in [0, 1], linear between some points.
struct PiecewiseLinear {
  Eigen::VectorXd tau;
  Eigen::VectorXd value;
};

/// `wished` at the middle of every interval, and the geometric mean of neighbours at the nodes.
PiecewiseLinear continuous(const Grid& grid, const Eigen::VectorXd& wished) {
  const Eigen::Index intervals = wished.size();
  const Eigen::VectorXd& nodes = grid.relative_times();
  PiecewiseLinear result{Eigen::VectorXd(2 * intervals + 1), Eigen::VectorXd(2 * intervals + 1)};
  for (Eigen::Index k = 0; k <= intervals; ++k) {
    result.tau[2 * k] = nodes[k];
    result.value[2 * k] = std::sqrt(wished[std::max<Eigen::Index>(k - 1, 0)] * wished[std::min(k, intervals - 1)]);
    if (k == intervals) break;
    result.tau[2 * k + 1] = 0.5 * (nodes[k] + nodes[k + 1]);
    result.value[2 * k + 1] = wished[k];
  }
  return result;
}

/// Makes it the largest function below it, at its points, that nowhere is steeper than `slope`.
void limit_slope(PiecewiseLinear& function, double slope) {
  const Eigen::Index points = function.tau.size();
  for (Eigen::Index i = 1; i < points; ++i) {
    function.value[i] =
        std::min(function.value[i], function.value[i - 1] + slope * (function.tau[i] - function.tau[i - 1]));
  }
  for (Eigen::Index i = points - 1; i > 0; --i) {
    function.value[i - 1] =
        std::min(function.value[i - 1], function.value[i] + slope * (function.tau[i] - function.tau[i - 1]));
  }
}

/// ln(1 + x)/x and (eˣ - 1)/x, 1 at 0.
double relative_log(double x) { return x == 0.0 ? 1.0 : std::log1p(x) / x; }
double relative_exp(double x) { return x == 0.0 ? 1.0 : std::expm1(x) / x; }

/// ∫ dτ / value from the first point to each.
Eigen::VectorXd node_numbers(const PiecewiseLinear& function) {
  Eigen::VectorXd numbers = Eigen::VectorXd::Zero(function.tau.size());
  for (Eigen::Index i = 1; i < numbers.size(); ++i) {
    const double left = function.value[i - 1];
    const double growth = function.value[i] / left - 1.0;
    numbers[i] = numbers[i - 1] + (function.tau[i] - function.tau[i - 1]) / left * relative_log(growth);
  }
  return numbers;
}

/// The τ that has a number between the numbers of points i and i + 1.
double tau_at(const PiecewiseLinear& function, const Eigen::VectorXd& numbers, Eigen::Index i, double number) {
  const double slope = (function.value[i + 1] - function.value[i]) / (function.tau[i + 1] - function.tau[i]);
  const double behind = number - numbers[i];
  return function.tau[i] + function.value[i] * behind * relative_exp(slope * behind);
}

}  // namespace

Grid graded_grid(const Grid& grid, const Eigen::VectorXd& wished, double largest_ratio) {
  if (wished.size() != grid.relative_widths().size() || !(wished.minCoeff() > 0.0)) {
    throw Error("a graded grid needs a positive width for every interval");
  }
  PiecewiseLinear width = continuous(grid, wished.cwiseMax(2.0 * Grid::narrowest).cwiseMin(1.0));
  limit_slope(width, std::log(largest_ratio));
  const Eigen::VectorXd numbers = node_numbers(width);
  const double all = numbers[numbers.size() - 1];
  if (!(all <= static_cast<double>(Grid::most_intervals))) {
    throw Error("the interval widths need {:g} intervals, more than a grid can have", all);
  }
  const auto intervals = std::max<Eigen::Index>(static_cast<Eigen::Index>(std::ceil(all - 1e-9)), 1);
  Eigen::VectorXd nodes(intervals + 1);
  nodes[0] = 0.0;
  nodes[intervals] = 1.0;
  Eigen::Index i = 0;
  for (Eigen::Index k = 1; k < intervals; ++k) {
    const double number = all * static_cast<double>(k) / static_cast<double>(intervals);
    while (i + 2 < numbers.size() && numbers[i + 1] < number) ++i;
    nodes[k] = tau_at(width, numbers, i, number);
  }
  return Grid::from_nodes(std::move(nodes));
}

EvenWidths equidistributed_widths(const Grid& grid, const Eigen::VectorXd& defects, int order, double share,
                                  double most_intervals) {
  constexpr double most_wider = 4.0;
  constexpr double most_narrower = 8.0;
  constexpr double smallest_defect = 1e-12;
  const double exponent = 1.0 / (order + 1);
  const Eigen::VectorXd& widths = grid.relative_widths();
  const auto intervals = static_cast<double>(widths.size());
  const double largest = defects.maxCoeff();
  if (!(largest > 0.0)) return {most_wider * widths, intervals / most_wider};
  if (!std::isfinite(largest)) return {0.5 * widths, 2.0 * intervals};
  const Eigen::ArrayXd counted = defects.array().max(smallest_defect * largest);
  // With n = Σ (d_k/g)^exponent intervals of defect g each, n g is `share` of Σ d_k.
  const double even = std::pow(share * counted.sum() / counted.pow(exponent).sum(), 1.0 + 1.0 / order);
  const Eigen::ArrayXd wider = (even / counted).pow(exponent);
  const double asked = wider.inverse().sum();
  const double excess = std::max(1.0, asked / most_intervals);
  return {widths.array() * (excess * wider).min(most_wider).max(1.0 / most_narrower), asked};
}

}  // namespace dmocbench
