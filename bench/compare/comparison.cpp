#include "bench/compare/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/run/column.hpp"
#include "methods/error.hpp"
#include "methods/numerics/median.hpp"

namespace dmocbench {

namespace {

bool is_rate(std::string_view counter) { return counter.ends_with("per_second"); }

SpeedVerdict verdict_on(const SpeedComparison& comparison, const ComparisonOptions& options) {
  if (std::min(comparison.repetitions_before, comparison.repetitions_after) < fewest_repetitions) {
    return SpeedVerdict::too_few_repetitions;
  }
  if (comparison.probability > options.significance) return SpeedVerdict::same;
  const double slowdown = is_rate(options.counter) ? 1.0 / comparison.ratio : comparison.ratio;
  if (slowdown > 1.0 && slowdown >= options.threshold) return SpeedVerdict::slower;
  if (slowdown < 1.0 && 1.0 / slowdown >= options.threshold) return SpeedVerdict::faster;
  return SpeedVerdict::same;
}

/// Twice the rank of every value, which is whole even where ranks are shared; those of the first sample come first.
std::vector<std::size_t> doubled_ranks(std::span<const double> first, std::span<const double> second) {
  std::vector<double> values(first.begin(), first.end());
  values.insert(values.end(), second.begin(), second.end());
  std::vector<double> sorted = values;
  std::ranges::sort(sorted);
  std::vector<std::size_t> ranks;
  for (const double value : values) {
    const auto [begin, end] = std::ranges::equal_range(sorted, value);
    ranks.push_back(static_cast<std::size_t>((begin - sorted.begin()) + (end - sorted.begin())) + 1);
  }
  return ranks;
}

std::size_t distance(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

/// The share of all choices of `chosen` ranks whose sum is at least `far` from `balanced`.
double exact_probability(const std::vector<std::size_t>& ranks, std::size_t chosen, std::size_t balanced,
                         std::size_t far) {
  const std::size_t all = ranks.size() * (ranks.size() + 1);  // the sum of doubled ranks
  // ways[c][s]: choices of c ranks with sum s.
  std::vector<std::vector<double>> ways(chosen + 1, std::vector<double>(all + 1, 0.0));
  ways[0][0] = 1.0;
  for (const std::size_t rank : ranks) {
    for (std::size_t c = chosen; c > 0; --c) {
      for (std::size_t s = rank; s <= all; ++s) ways[c][s] += ways[c - 1][s - rank];
    }
  }
  double as_far = 0.0;
  for (std::size_t s = 0; s <= all; ++s) as_far += distance(s, balanced) >= far ? ways[chosen][s] : 0.0;
  return as_far / std::accumulate(ways[chosen].begin(), ways[chosen].end(), 0.0);
}

/// The same by the normal distribution with the variance of a sum of ranks that are drawn without replacement.
double normal_probability(const std::vector<std::size_t>& ranks, std::size_t chosen, std::size_t far) {
  const auto count = static_cast<double>(ranks.size());
  double variance = 0.0;  // of the doubled ranks, whose mean is count + 1
  for (const std::size_t rank : ranks) variance += std::pow(static_cast<double>(rank) - count - 1.0, 2) / (count - 1.0);
  if (variance == 0.0) return 1.0;
  const auto drawn = static_cast<double>(chosen);
  const double deviation = std::sqrt(variance * drawn * (count - drawn) / count);
  return std::erfc(static_cast<double>(far) / deviation / std::numbers::sqrt2);
}

}  // namespace

std::string_view name_of(SpeedVerdict verdict) noexcept {
  static constexpr std::array names{"faster", "slower", "same within noise", "too few repetitions"};
  return names[static_cast<std::size_t>(verdict)];
}

std::vector<SpeedComparison> compare(const BenchmarkSamples& before, const BenchmarkSamples& after,
                                     const ComparisonOptions& options) {
  const bool are_sensible =  // false for NaN
      options.threshold >= 1.0 && options.significance >= 0.0 && options.significance <= 1.0;
  if (!are_sensible) {
    throw Error(fmt::format("a threshold is at least 1 and a significance between 0 and 1, not {} and {}",
                            options.threshold, options.significance));
  }
  std::vector<SpeedComparison> comparisons;
  for (const auto& [name, earlier] : before) {
    const auto found = after.find(name);
    if (found == after.end()) continue;
    const std::vector<double>& later = found->second;
    SpeedComparison comparison{.name = name,
                               .repetitions_before = earlier.size(),
                               .repetitions_after = later.size(),
                               .median_before = median(earlier),
                               .median_after = median(later),
                               .probability = mann_whitney(earlier, later)};
    comparison.ratio = comparison.median_after / comparison.median_before;
    comparison.verdict = verdict_on(comparison, options);
    comparisons.push_back(comparison);
  }
  if (comparisons.empty()) {
    throw Error(
        fmt::format("the files have no benchmark in common: one has {}, the other {}; compare two runs of one program",
                    before.begin()->first, after.begin()->first));
  }
  return comparisons;
}

Table comparison_table(const std::vector<SpeedComparison>& comparisons) {
  const Columns<SpeedComparison> columns{
      {"benchmark", "", "its name", &SpeedComparison::name},
      {"repetitions_before", "", "number of repetitions, or of runs", &SpeedComparison::repetitions_before},
      {"repetitions_after", "", "the same of what is compared with it", &SpeedComparison::repetitions_after},
      {"median_before", "", "of the counter", &SpeedComparison::median_before},
      {"median_after", "", "of the counter", &SpeedComparison::median_after},
      {"ratio", "", "median after over median before", &SpeedComparison::ratio},
      {"probability", "", "of a difference like this by chance", &SpeedComparison::probability},
      {"verdict", "", "of the comparison", [](const SpeedComparison& c) { return name_of(c.verdict); }}};
  return table_of(columns, comparisons);
}

std::string comparison_text(const std::vector<SpeedComparison>& comparisons) {
  std::size_t width = 0;
  std::map<SpeedVerdict, std::size_t> counts;
  for (const SpeedComparison& comparison : comparisons) {
    width = std::max(width, comparison.name.size());
    ++counts[comparison.verdict];
  }
  std::string text = fmt::format("{:<{}} {:>12} {:>12} {:>8} {:>8}  verdict\n", "median of", width, "before", "after",
                                 "ratio", "chance");
  for (const SpeedComparison& comparison : comparisons) {
    text += fmt::format("{:<{}} {:>12.5g} {:>12.5g} {:>8.3f} {:>8.2g}  {}\n", comparison.name, width,
                        comparison.median_before, comparison.median_after, comparison.ratio, comparison.probability,
                        name_of(comparison.verdict));
  }
  std::vector<std::string> verdicts;
  verdicts.reserve(counts.size());
  for (const auto& [verdict, count] : counts) verdicts.push_back(fmt::format("{} {}", count, name_of(verdict)));
  return fmt::format("{}{}\n", text, fmt::join(verdicts, ", "));
}

double mann_whitney(std::span<const double> first, std::span<const double> second) {
  if (first.empty() || second.empty()) throw Error("a test of two samples needs values in both");
  constexpr std::size_t most_values_of_exact_test = 40;
  const std::vector<std::size_t> ranks = doubled_ranks(first, second);
  std::size_t sum = 0;
  for (std::size_t i = 0; i < first.size(); ++i) sum += ranks[i];
  const std::size_t balanced = first.size() * (ranks.size() + 1);
  const std::size_t far = distance(sum, balanced);
  return ranks.size() <= most_values_of_exact_test ? exact_probability(ranks, first.size(), balanced, far)
                                                   : normal_probability(ranks, first.size(), far);
}

}  // namespace dmocbench
