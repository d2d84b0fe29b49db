#pragma once

#include <cstddef>

namespace dmocbench {

/// An interval of confidence, 95 %, for a share or for the difference of two.
struct ShareInterval {
  double lower = 0.0;
  double upper = 1.0;
};

/// Successes among independent trials.
struct ShareCount {
  std::size_t hits = 0;
  std::size_t trials = 0;
  [[nodiscard]] double share() const { return static_cast<double>(hits) / static_cast<double>(trials); }
};

/// Wilson's interval for the share of a count: all shares π with |hits/n - π| <= z √(π(1 - π)/n). It needs at least
/// one trial, and fits small counts and shares near 0 and 1 as well.
[[nodiscard]] ShareInterval wilson_interval(const ShareCount& count);

/// Newcombe's interval for the difference of the shares of two counts, first less second, from Wilson's of each
/// ("Interval estimation for the difference between independent proportions", 1998, method 10).
[[nodiscard]] ShareInterval difference_interval(const ShareCount& first, const ShareCount& second);

}  // namespace dmocbench
