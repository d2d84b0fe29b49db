#include "bench/tables/ratio_interval.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "methods/error.hpp"
#include "methods/numerics/quantile.hpp"

namespace dmocbench {

namespace {

void require_times(std::span<const double> times) {
  if (times.empty()) throw Error("a confidence interval of a ratio needs at least one round");
  for (const double time : times) {
    if (std::isfinite(time) && time > 0.0) continue;
    throw Error("a time or a ratio of times is {:g}; times must be positive", time);
  }
}

/// The median of as many values, drawn from them with replacement.
double median_of_drawn(std::span<const double> values, std::mt19937& engine) {
  std::vector<double> drawn;
  drawn.reserve(values.size());
  // The remainder is not exactly even, but the same on every machine, unlike the library's distributions.
  for (std::size_t i = 0; i < values.size(); ++i) drawn.push_back(values[engine() % values.size()]);
  return median(std::move(drawn));
}

void set_bounds(RatioInterval& interval) {
  std::vector<double> sorted = interval.resampled;
  std::ranges::sort(sorted);
  constexpr std::size_t outside = resamples / 200;  // half a percent on each side
  interval.lower = sorted[outside];
  interval.upper = sorted[resamples - 1 - outside];
}

constexpr unsigned seed = 20090101U;  // the same draws each time

}  // namespace

RatioInterval ratio_interval(std::span<const double> ratios) {
  require_times(ratios);
  RatioInterval interval{.ratio = median({ratios.begin(), ratios.end()}), .rounds = ratios.size()};
  std::mt19937 engine(seed);  // NOLINT(cert-msc51-cpp)
  for (std::size_t b = 0; b < resamples; ++b) interval.resampled.push_back(median_of_drawn(ratios, engine));
  set_bounds(interval);
  return interval;
}

MedianOfRounds::MedianOfRounds(std::span<const double> of_rounds) : rounds(joined_numbers(of_rounds)) {
  if (of_rounds.empty()) return;
  const RatioInterval interval = ratio_interval(of_rounds);
  median = interval.ratio;
  lower = interval.lower;
  upper = interval.upper;
}

std::vector<double> round_ratios(std::span<const double> times, std::span<const double> others) {
  std::vector<double> ratios(std::min(times.size(), others.size()));
  for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] = times[i] / others[i];
  return ratios;
}

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

}  // namespace dmocbench
