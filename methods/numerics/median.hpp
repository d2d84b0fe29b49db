#pragma once

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace dmocbench {

/// The median of `numbers`: with an even count, the mean of the two in the middle; NaN if there are none.
[[nodiscard]] inline double median(std::vector<double> numbers) {
  if (numbers.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  if (numbers.size() % 2 != 0) return *middle;
  return std::midpoint(*std::max_element(numbers.begin(), middle), *middle);
}

}  // namespace dmocbench
