#include "bench/compare/mann_whitney.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

constexpr std::size_t most_values_of_exact_test = 40;

/// Twice the rank of every value, which is whole even where ranks are shared; those of the first sample come first.
std::vector<std::size_t> doubled_ranks(std::span<const double> first, std::span<const double> second) {
  std::vector<double> values(first.begin(), first.end());
  values.insert(values.end(), second.begin(), second.end());
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::size_t> ranks;
  for (const double value : values) {
    const auto [begin, end] = std::equal_range(sorted.begin(), sorted.end(), value);
    ranks.push_back(static_cast<std::size_t>(begin - sorted.begin()) + static_cast<std::size_t>(end - sorted.begin()) +
                    1);
  }
  return ranks;
}

/// The share of all choices of `chosen` ranks whose sum is at least as far from the mean as `sum`.
double exact_probability(const std::vector<std::size_t>& ranks, std::size_t chosen, std::size_t sum) {
  std::size_t all = 0;
  for (const std::size_t rank : ranks) all += rank;
  // ways[c][s]: choices of c ranks with sum s.
  std::vector<std::vector<double>> ways(chosen + 1, std::vector<double>(all + 1, 0.0));
  ways[0][0] = 1.0;
  for (const std::size_t rank : ranks) {
    for (std::size_t c = chosen; c > 0; --c) {
      for (std::size_t s = rank; s <= all; ++s) ways[c][s] += ways[c - 1][s - rank];
    }
  }
  // The mean of the sums is all · chosen / count; both sides times count are whole.
  const auto distance = [&](std::size_t s) {
    const std::size_t here = s * ranks.size();
    const std::size_t balanced = all * chosen;
    return here > balanced ? here - balanced : balanced - here;
  };
  double far = 0.0;
  double total = 0.0;
  for (std::size_t s = 0; s <= all; ++s) {
    total += ways[chosen][s];
    if (distance(s) >= distance(sum)) far += ways[chosen][s];
  }
  return far / total;
}

double normal_probability(const std::vector<std::size_t>& ranks, std::size_t chosen, std::size_t sum) {
  const auto count = static_cast<double>(ranks.size());
  std::size_t all = 0;
  for (const std::size_t rank : ranks) all += rank;
  const double mean = static_cast<double>(all) / count;
  double variance = 0.0;
  for (const std::size_t rank : ranks) variance += std::pow(static_cast<double>(rank) - mean, 2) / (count - 1.0);
  if (variance == 0.0) return 1.0;
  const auto drawn = static_cast<double>(chosen);
  // Of a sum of ranks drawn without putting them back.
  const double deviation = std::sqrt(variance * drawn * (count - drawn) / count);
  return std::erfc(std::abs(static_cast<double>(sum) - drawn * mean) / deviation / std::numbers::sqrt2);
}

}  // namespace

double mann_whitney(std::span<const double> first, std::span<const double> second) {
  if (first.empty() || second.empty()) throw Error("a test of two samples needs values in both");
  const std::vector<std::size_t> ranks = doubled_ranks(first, second);
  std::size_t sum = 0;
  for (std::size_t i = 0; i < first.size(); ++i) sum += ranks[i];
  return ranks.size() <= most_values_of_exact_test ? exact_probability(ranks, first.size(), sum)
                                                   : normal_probability(ranks, first.size(), sum);
}

}  // namespace dmocbench
