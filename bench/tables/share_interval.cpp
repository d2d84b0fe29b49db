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

}  // namespace dmocbench
