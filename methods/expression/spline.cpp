#include "methods/expression/spline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

void require_table(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() != y.size()) {
    throw Error("the table of a spline has {} x values but {} y values; their numbers must be equal", x.size(),
                y.size());
  }
  if (x.size() < 2) throw Error("the table of a spline needs at least two points, got {}", x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isfinite(x[i]) && std::isfinite(y[i]) && (i == 0 || x[i] > x[i - 1])) continue;
    throw Error("the x values of a spline must be finite and increasing, but point {} is ({:g}, {:g})", i + 1, x[i],
                y[i]);
  }
}

/// s'' at the points, 0 at both ends: h_(i-1) s''_(i-1) + 2 (h_(i-1) + h_i) s''_i + h_i s''_(i+1) = 6 (δ_i - δ_(i-1))
/// with the slopes δ of the chords, by elimination from the left; the system is diagonally dominant.
std::vector<double> second_derivatives(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t last = x.size() - 1;
  std::vector<double> second(x.size(), 0.0);
  std::vector<double> upper(x.size(), 0.0);
  const auto width = [&](std::size_t i) { return x[i + 1] - x[i]; };
  const auto chord = [&](std::size_t i) { return (y[i + 1] - y[i]) / width(i); };
  for (std::size_t i = 1; i < last; ++i) {
    const double pivot = 2.0 * (width(i - 1) + width(i)) - width(i - 1) * upper[i - 1];
    upper[i] = width(i) / pivot;
    second[i] = (6.0 * (chord(i) - chord(i - 1)) - width(i - 1) * second[i - 1]) / pivot;
  }
  for (std::size_t i = last; i-- > 1;) second[i] -= upper[i] * second[i + 1];
  return second;
}

}  // namespace

Spline::Spline(std::vector<double> x, std::vector<double> y) : before_() {
  require_table(x, y);
  const std::vector<double> second = second_derivatives(x, y);
  const std::size_t last = x.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const double h = x[i + 1] - x[i];
    const double slope = (y[i + 1] - y[i]) / h - h * (2.0 * second[i] + second[i + 1]) / 6.0;
    cubics_.push_back({x[i], y[i], slope, second[i] / 2.0, (second[i + 1] - second[i]) / (6.0 * h)});
  }
  const double h = x[last] - x[last - 1];
  const double last_slope = (y[last] - y[last - 1]) / h + h * second[last - 1] / 6.0;
  before_ = {x[0], y[0], cubics_.front().slope, 0.0, 0.0};
  cubics_.push_back({x[last], y[last], last_slope, 0.0, 0.0});
}

double Spline::operator()(double x) const {
  const auto next = std::ranges::find_if(cubics_, [x](const Cubic& cubic) { return !(x > cubic.x); });
  const Cubic& cubic = next == cubics_.begin() ? before_ : *(next - 1);
  return cubic.at(x - cubic.x);
}

Expression Spline::operator()(const Expression& x) const {
  // Each cubic counts from its own point to the next one. Whether a point is passed is tested once, so that everywhere
  // exactly one of the factors is 1 and the others are 0, to the last bit.
  Expression sum;
  Expression passed(1.0);
  const Cubic* current = &before_;
  for (const Cubic& next : cubics_) {
    const Expression next_passed = detail::unit_step(x - next.x);
    sum += (passed - next_passed) * current->at(Expression(x - current->x));
    passed = next_passed;
    current = &next;
  }
  return sum + passed * current->at(Expression(x - current->x));
}

}  // namespace dmocbench
