#pragma once

#include <vector>

namespace dmocbench {

/// The number in the middle of `numbers`, of an even count the mean of the two in the middle; NaN of none.
[[nodiscard]] double median(std::vector<double> numbers);

}  // namespace dmocbench
