#include "bench/compare/comparison.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "bench/compare/mann_whitney.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

bool is_rate(std::string_view counter) { return counter.ends_with("per_second"); }

SpeedVerdict verdict_on(const SpeedComparison& what, const ComparisonOptions& options) {
  if (std::min(what.repetitions_before, what.repetitions_after) < fewest_repetitions) {
    return SpeedVerdict::too_few_repetitions;
  }
  if (what.probability > options.significance) return SpeedVerdict::same;
  const double slowdown = is_rate(options.counter) ? 1.0 / what.ratio : what.ratio;
  if (slowdown > 1.0 && slowdown >= options.threshold) return SpeedVerdict::slower;
  if (slowdown < 1.0 && 1.0 / slowdown >= options.threshold) return SpeedVerdict::faster;
  return SpeedVerdict::same;
}

}  // namespace

std::string_view name_of(SpeedVerdict verdict) noexcept {
  switch (verdict) {
    case SpeedVerdict::faster:
      return "faster";
    case SpeedVerdict::slower:
      return "slower";
    case SpeedVerdict::same:
      return "same within noise";
    case SpeedVerdict::too_few_repetitions:
      return "too few repetitions";
  }
  return "unknown";
}

std::vector<SpeedComparison> compare(const BenchmarkSamples& before, const BenchmarkSamples& after,
                                     const ComparisonOptions& options) {
  if (!(options.threshold >= 1.0) || !(options.significance >= 0.0 && options.significance <= 1.0)) {  // true for NaN
    throw Error(fmt::format("a threshold is at least 1 and a significance between 0 and 1, not {} and {}",
                            options.threshold, options.significance));
  }
  std::vector<SpeedComparison> comparisons;
  for (const auto& [name, earlier] : before) {
    const auto found = after.find(name);
    if (found == after.end()) continue;
    const std::vector<double>& later = found->second;
    SpeedComparison what{.name = name,
                         .repetitions_before = earlier.size(),
                         .repetitions_after = later.size(),
                         .median_before = median_of(earlier),
                         .median_after = median_of(later),
                         .probability = mann_whitney(earlier, later)};
    what.ratio = what.median_after / what.median_before;
    what.verdict = verdict_on(what, options);
    comparisons.push_back(what);
  }
  if (comparisons.empty()) {
    throw Error(
        fmt::format("the files have no benchmark in common: one has {}, the other {}; compare two runs of one "
                    "program",
                    before.begin()->first, after.begin()->first));
  }
  return comparisons;
}

Table comparison_table(const std::vector<SpeedComparison>& comparisons) {
  Table table({"benchmark", "repetitions_before", "repetitions_after", "median_before", "median_after", "ratio",
               "probability", "verdict"});
  for (const SpeedComparison& what : comparisons) {
    Row row;
    row.set("benchmark", Cell(what.name));
    row.set("repetitions_before", Cell(static_cast<long long>(what.repetitions_before)));
    row.set("repetitions_after", Cell(static_cast<long long>(what.repetitions_after)));
    row.set("median_before", Cell(what.median_before));
    row.set("median_after", Cell(what.median_after));
    row.set("ratio", Cell(what.ratio));
    row.set("probability", Cell(what.probability));
    row.set("verdict", Cell(std::string(name_of(what.verdict))));
    table.append(row);
  }
  return table;
}

std::string comparison_text(const std::vector<SpeedComparison>& comparisons) {
  std::size_t width = 0;
  std::map<SpeedVerdict, std::size_t> counts;
  for (const SpeedComparison& what : comparisons) {
    width = std::max(width, what.name.size());
    ++counts[what.verdict];
  }
  std::string text = fmt::format("{:<{}} {:>12} {:>12} {:>8} {:>8}  verdict\n", "median of", width, "before", "after",
                                 "ratio", "chance");
  for (const SpeedComparison& what : comparisons) {
    text += fmt::format("{:<{}} {:>12.5g} {:>12.5g} {:>8.3f} {:>8.2g}  {}\n", what.name, width, what.median_before,
                        what.median_after, what.ratio, what.probability, name_of(what.verdict));
  }
  std::string separator;
  for (const auto& [verdict, count] : counts) {
    text += fmt::format("{}{} {}", separator, count, name_of(verdict));
    separator = ", ";
  }
  return text + "\n";
}

}  // namespace dmocbench
