#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compare/benchmark_file.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// How the second of two samples of times compares with the first.
enum class SpeedVerdict : std::uint8_t {
  faster,               ///< beyond noise, and the ratio of medians reaches the threshold
  slower,               ///< the same in the other direction
  same,                 ///< neither
  too_few_repetitions,  ///< one of the two has less than `fewest_repetitions`
};

/// Smaller samples have no verdict: two of 4 are wholly apart by chance in one of 35 cases.
inline constexpr std::size_t fewest_repetitions = 5;

/// "faster", "slower", "same within noise" or "too few repetitions".
[[nodiscard]] std::string_view name_of(SpeedVerdict verdict) noexcept;

struct ComparisonOptions {
  std::string counter = "cpu_time";
  double threshold = 1.05;     ///< smallest ratio of medians that is worth a verdict, at least 1
  double significance = 0.01;  ///< largest probability of chance (`mann_whitney`) that counts as a difference
};

/// One benchmark before and after.
struct SpeedComparison {
  std::string name;
  std::size_t repetitions_before = 0;
  std::size_t repetitions_after = 0;
  double median_before = 0.0;
  double median_after = 0.0;
  double ratio = 0.0;        ///< median after / median before
  double probability = 0.0;  ///< of chance
  SpeedVerdict verdict = SpeedVerdict::same;
};

/// The benchmarks that both have, by name. More of a counter is slower, unless it is a rate (its name ends with
/// "per_second"). Throws `Error` if they have none in common or an option is out of its range.
[[nodiscard]] std::vector<SpeedComparison> compare(const BenchmarkSamples& before, const BenchmarkSamples& after,
                                                   const ComparisonOptions& options);

[[nodiscard]] Table comparison_table(const std::vector<SpeedComparison>& comparisons);

/// A line per benchmark, and one that counts the verdicts.
[[nodiscard]] std::string comparison_text(const std::vector<SpeedComparison>& comparisons);

/// The Mann-Whitney U test, two-sided: the probability that ranks are as far from balanced as these if both samples
/// are of one distribution.
///
/// Equal values share the mean of their ranks. Up to 40 values in all the probability is exact: the share of all ways
/// to divide these very ranks that are at least as far from balanced. Beyond, it is that of the normal distribution
/// with the same variance. It is 1 if all values are equal. Throws `Error` if a sample is empty.
[[nodiscard]] double mann_whitney(std::span<const double> first, std::span<const double> second);

}  // namespace dmocbench
