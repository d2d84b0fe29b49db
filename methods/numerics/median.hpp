#pragma once

#include <vector>

namespace dmocbench {

/// The median of `numbers`: with an even count, the mean of the two in the middle; NaN if there are none.
[[nodiscard]] double median(std::vector<double> numbers);

}  // namespace dmocbench
