#include "bench/claims/timed_ratios.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dmocbench {

void TimedRatios::add(std::string name, const std::vector<double>& of_rounds) {
  ratios_.emplace_back(std::move(name), ratio_interval(of_rounds));
}

std::size_t TimedRatios::rounds() const {
  if (ratios_.empty()) return 0;
  return std::ranges::min(ratios_, {}, [](const auto& ratio) { return ratio.second.rounds; }).second.rounds;
}

ClaimVerdict TimedRatios::verdict() const {
  if (rounds() < fewest_rounds) return ClaimVerdict::undecided;
  const auto is_above = [&](const auto& ratio) { return ratio.second.lower > threshold_; };
  const auto is_below = [&](const auto& ratio) { return ratio.second.upper <= threshold_; };
  if (std::ranges::any_of(ratios_, is_below)) return ClaimVerdict::differs;
  return std::ranges::all_of(ratios_, is_above) ? ClaimVerdict::reproduced : ClaimVerdict::undecided;
}

Words TimedRatios::in_words() const {
  return joined(ratios_, ", ", [](const std::pair<std::string, RatioInterval>& named) {
    const auto& [name, interval] = named;
    return worded("{} {:.2f} ({:.2f} to {:.2f})", name, Measurement{"ratio of times", interval.ratio, "", name},
                  Measurement{"lower confidence limit of the ratio", interval.lower, "", name},
                  Measurement{"upper confidence limit of the ratio", interval.upper, "", name});
  });
}

std::size_t TimedRatios::resamples_above() const {
  std::size_t count = 0;
  for (std::size_t b = 0; b < resamples; ++b) {
    const auto is_above = [&](const auto& ratio) { return ratio.second.resampled[b] > threshold_; };
    count += std::ranges::all_of(ratios_, is_above) ? 1 : 0;
  }
  return count;
}

std::string TimedRatios::sure() const {
  if (rounds() < fewest_rounds) return "";
  const std::size_t above = resamples_above();
  switch (verdict()) {
    case ClaimVerdict::reproduced:
      return fmt::format("{} of {} resamples of this run's rounds", above, resamples);
    case ClaimVerdict::differs:
      return fmt::format("{} of {} resamples of this run's rounds", resamples - above, resamples);
    default:
      return fmt::format("the statement holds in {} of {} resamples of this run's rounds", above, resamples);
  }
}

std::vector<double> means_of_rounds(const std::vector<std::vector<double>>& of_programs) {
  if (of_programs.empty()) return {};
  std::vector<double> means(std::ranges::min(of_programs, {}, &std::vector<double>::size).size());
  for (std::size_t round = 0; round < means.size(); ++round) {
    double sum = 0.0;
    for (const std::vector<double>& of_rounds : of_programs) sum += std::log(of_rounds[round]);
    means[round] = std::exp(sum / static_cast<double>(of_programs.size()));
  }
  return means;
}

Finding found_by_times(const TimedRatios& ratios, const std::string& before) {
  Finding finding = found(ratios.verdict(), "{}{}", before, ratios.in_words()).as_sure_as(ratios.sure());
  if (ratios.rounds() >= fewest_rounds) return finding;
  return std::move(finding).because(
      worded("the table has {} rounds; a verdict on times needs at least {}", ratios.rounds(), fewest_rounds));
}

}  // namespace dmocbench
