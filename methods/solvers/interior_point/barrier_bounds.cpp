#include "methods/solvers/interior_point/barrier_bounds.hpp"

#include <cmath>

namespace dmocbench::interior_point {

namespace {

/// Σ ln, of eight numbers at a time: a product is cheaper than eight logarithms.
template <class Numbers>
double sum_of_logarithms(const Numbers& numbers) {
  constexpr Eigen::Index at_once = 8;
  constexpr double smallest = 1e-30;  // its eighth power is a number still
  constexpr double largest = 1e30;
  double sum = 0.0;
  Eigen::Index i = 0;
  for (; i + at_once <= numbers.size(); i += at_once) {
    const Eigen::Array<double, at_once, 1> some = numbers.template segment<at_once>(i);
    const bool is_usual = some.minCoeff() > smallest && some.maxCoeff() < largest;
    sum += is_usual ? std::log(some.prod()) : some.log().sum();
  }
  return sum + numbers.tail(numbers.size() - i).log().sum();
}

}  // namespace

BarrierBounds::BarrierBounds(const Primal& lower, const Primal& upper) {
  for (std::size_t set = 0; set < counts_.size(); ++set) {
    const auto part = set < 2 ? &Primal::x : &Primal::s;
    const bool is_lower = set % 2 == 0;
    const Eigen::VectorXd& low = lower.*part;
    const Eigen::VectorXd& high = upper.*part;
    const Eigen::VectorXd& values = is_lower ? low : high;
    Eigen::Index begin = 0;  // of the stretch that ends at `end`
    Eigen::Index end = 0;
    const auto add_stretch = [&] {
      if (begin == end) return;
      stretches_.push_back(
          {part, is_lower ? 1.0 : -1.0, set, begin, counts_[set], values.segment(begin, end - begin).array()});
      counts_[set] += end - begin;
    };
    for_each_bounded(low, high, [&](Eigen::Index i) {
      if (!std::isfinite(values[i]) || low[i] == high[i]) return;
      if (i != end) {
        add_stretch();
        begin = i;
      }
      end = i + 1;
    });
    add_stretch();
    count_ += counts_[set];
  }
}

void BarrierBounds::read(const Primal& lower, const Primal& upper) {
  for (BoundStretch& bounds : stretches_) bounds.values = bounds.entries(bounds.side > 0.0 ? lower : upper);
}

void BarrierBounds::set_multipliers(double value, BoundMultipliers& z) const {
  for (std::size_t set = 0; set < counts_.size(); ++set) z[set].setConstant(counts_[set], value);
}

double BarrierBounds::barrier(const Primal& at) const {
  Sums sums;
  for (const BoundStretch& some : stretches_) sums.of[some.set] -= sum_of_logarithms(some.distances(at));
  return sums.total();
}

double pushed_inside(double value, double lower, double upper, double share) {
  const double distance = upper - lower;  // infinite where a bound is missing
  if (std::isfinite(lower)) value = std::max(value, lower + share * std::min(std::max(1.0, std::abs(lower)), distance));
  if (std::isfinite(upper)) value = std::min(value, upper - share * std::min(std::max(1.0, std::abs(upper)), distance));
  return value;
}

}  // namespace dmocbench::interior_point
