#pragma once

#include <span>

namespace dmocbench {

/// The Mann-Whitney U test, two-sided: how likely ranks as far from balanced as these are if both samples are of one
/// distribution.
///
/// Equal values share the mean of their ranks. Up to 40 values in all the probability is exact: the share of all ways
/// to divide these very ranks that are at least as far from balanced. Beyond, it is that of the normal distribution
/// with the same variance. It is 1 if all values are equal. Throws `Error` if a sample is empty.
[[nodiscard]] double mann_whitney(std::span<const double> first, std::span<const double> second);

}  // namespace dmocbench
