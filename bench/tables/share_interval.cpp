#include "bench/tables/share_interval.hpp"

#include <algorithm>
#include <cmath>

namespace dmocbench {

ShareInterval wilson_interval(const ShareCount& count) {
  constexpr double z = 1.959963984540054;  // 97.5 % of a normal distribution lie below
  const auto n = static_cast<double>(count.trials);
  const double share = count.share();
  const double centre = share + z * z / (2.0 * n);
  const double half_width = z * std::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
  const double norm = 1.0 + z * z / n;
  return {std::max(0.0, (centre - half_width) / norm), std::min(1.0, (centre + half_width) / norm)};
}

ShareInterval difference_interval(const ShareCount& first, const ShareCount& second) {
  const ShareInterval a = wilson_interval(first);
  const ShareInterval b = wilson_interval(second);
  const double difference = first.share() - second.share();
  return {difference - std::hypot(first.share() - a.lower, b.upper - second.share()),
          difference + std::hypot(a.upper - first.share(), second.share() - b.lower)};
}

namespace {

/// The correlation of the two outcomes, corrected for continuity; 0 where one of them is always the same.
double correlation_of(const PairedCount& count) {
  const auto a = static_cast<double>(count.both);
  const auto b = static_cast<double>(count.first_only);
  const auto c = static_cast<double>(count.second_only);
  const auto d = static_cast<double>(count.neither);
  const double margins = (a + b) * (c + d) * (a + c) * (b + d);
  if (margins == 0.0) return 0.0;
  const double determinant = a * d - b * c;
  const double corrected = determinant > 0.0 ? std::max(0.0, determinant - 0.5 * (a + b + c + d)) : determinant;
  return corrected / std::sqrt(margins);
}

}  // namespace

ShareInterval paired_difference_interval(const PairedCount& count) {
  const ShareInterval a = wilson_interval(count.first());
  const ShareInterval b = wilson_interval(count.second());
  const double first = count.first().share();
  const double second = count.second().share();
  const double correlation = correlation_of(count);
  const auto half = [&](double x, double y) {
    return std::sqrt(std::max(0.0, x * x - 2.0 * correlation * x * y + y * y));
  };
  return {first - second - half(first - a.lower, b.upper - second),
          first - second + half(a.upper - first, second - b.lower)};
}

}  // namespace dmocbench
