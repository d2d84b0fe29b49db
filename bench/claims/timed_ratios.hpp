#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/claims/claim.hpp"
#include "bench/tables/ratio_interval.hpp"

namespace dmocbench {

/// Ratios of times, measured in rounds, that a claim expects to lie above a threshold.
///
/// The claim holds if every interval lies above it, does not if one lies wholly at or below it, and is undecided
/// otherwise, or with less than `fewest_rounds` rounds.
class TimedRatios {
 public:
  explicit TimedRatios(double threshold) : threshold_(threshold) {}

  /// Adds a ratio with one value per round. Throws `Error` if there are no values or one is not a ratio of times.
  void add(std::string name, const std::vector<double>& of_rounds);

  [[nodiscard]] ClaimVerdict verdict() const;
  /// "ipopt 1.25 (1.21 to 1.30), sparse 1.40 (1.38 to 1.41)": medians with their intervals.
  [[nodiscard]] Words in_words() const;
  /// "993 of 1000 resamples of this run's rounds": how often the verdict follows from them; for "undecided" how often
  /// the claim holds. Another run, on another machine, may have another verdict.
  [[nodiscard]] std::string sure() const;
  /// The smallest number of rounds of a ratio; 0 without ratios.
  [[nodiscard]] std::size_t rounds() const;

 private:
  [[nodiscard]] std::size_t resamples_above() const;

  double threshold_;
  std::vector<std::pair<std::string, RatioInterval>> ratios_;
};

/// The geometric means over several programs, round by round, of a ratio that each has once per round; as many as the
/// program with the fewest rounds has. A single small program would be judged by the clock's noise.
[[nodiscard]] std::vector<double> means_of_rounds(const std::vector<std::vector<double>>& of_programs);

/// The finding on a claim from the ratios, in words with `before` in front.
[[nodiscard]] Finding found_by_times(const TimedRatios& ratios, const std::string& before);

}  // namespace dmocbench
