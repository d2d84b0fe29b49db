#include "bench/summary/ratio_interval.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/numerics/median.hpp"

namespace dmocbench {

RatioInterval ratio_interval(std::span<const double> ratios) {
  if (ratios.empty()) throw Error("an interval of a ratio needs a round");
  for (const double ratio : ratios) {
    if (!std::isfinite(ratio) || ratio <= 0.0) throw Error(fmt::format("{} is no ratio of two times", ratio));
  }
  RatioInterval interval{.ratio = median({ratios.begin(), ratios.end()}), .rounds = ratios.size(), .resampled = {}};
  std::mt19937 engine(20090101U);  // NOLINT(cert-msc51-cpp): the same draws each time
  for (std::size_t b = 0; b < resamples; ++b) {
    std::vector<double> drawn;
    drawn.reserve(ratios.size());
    // The remainder is not exactly even, but the same on every machine, unlike the library's distributions.
    for (std::size_t i = 0; i < ratios.size(); ++i) drawn.push_back(ratios[engine() % ratios.size()]);
    interval.resampled.push_back(median(std::move(drawn)));
  }
  std::vector<double> sorted = interval.resampled;
  std::ranges::sort(sorted);
  constexpr std::size_t outside = resamples / 200;  // half a percent on each side
  interval.lower = sorted[outside];
  interval.upper = sorted[resamples - 1 - outside];
  return interval;
}

void set_rounds(Row& result, std::span<const double> ratios) {
  if (ratios.empty()) return;
  const RatioInterval interval = ratio_interval(ratios);
  result.set("ratio_lower", interval.lower);
  result.set("ratio_upper", interval.upper);
  result.set("round_ratios", joined_numbers(ratios));
}

std::vector<double> round_ratios(std::span<const double> times, std::span<const double> others) {
  std::vector<double> ratios(std::min(times.size(), others.size()));
  for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] = times[i] / others[i];
  return ratios;
}

}  // namespace dmocbench
