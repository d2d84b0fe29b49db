#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/run/column.hpp"

namespace dmocbench {

/// Fewer rounds are too few for a verdict on times.
inline constexpr std::size_t fewest_rounds = 10;
/// The number of resamples of the rounds.
inline constexpr std::size_t resamples = 1000;

/// The ratio of two times that were measured in turn, round after round, so that other load of the machine slowed both.
///
/// The ratio is the median over the rounds. Its interval comes from the bootstrap: rounds are drawn again with
/// replacement, `resamples` times from a fixed seed, and the interval holds 99 % of the medians. Equal numbers of
/// rounds draw the same rounds, so that `resampled[b]` of several ratios belong together.
struct RatioInterval {
  double ratio = 0.0;                  ///< the median
  double lower = 0.0;                  ///< end of the interval
  double upper = 0.0;                  ///< end of the interval
  std::size_t rounds = 0;              ///< number of ratios
  std::vector<double> resampled = {};  ///< the medians, in the order of drawing
};

/// The interval of the median of ratios, one of each round. Throws `Error` without ratios or if one is not a finite
/// number above zero.
[[nodiscard]] RatioInterval ratio_interval(std::span<const double> ratios);

/// Measurements round by round, as tables show them: the median with its interval, and the rounds; empty without
/// them.
struct MedianOfRounds {
  MedianOfRounds() = default;
  /// Throws `Error` as `ratio_interval` does.
  explicit MedianOfRounds(std::span<const double> of_rounds);

  std::optional<double> median;  ///< of the rounds
  std::optional<double> lower;   ///< end of its interval
  std::optional<double> upper;   ///< end of its interval
  std::string rounds;            ///< all of them, with spaces between them
};

/// ratio_lower, ratio_upper and round_ratios, from which the interval comes; `ratios` is a member of the record, or
/// the arguments of `from` after one.
template <class Record, class... Members>
[[nodiscard]] Columns<Record> round_columns(Members... ratios) {
  return {
      {"ratio_lower", "", "lower 99 % confidence limit of the median ratio, if rounds were timed",
       from(ratios..., &MedianOfRounds::lower)},
      {"ratio_upper", "", "upper 99 % confidence limit of the median ratio", from(ratios..., &MedianOfRounds::upper)},
      {"round_ratios", "", "ratios of the rounds, separated by spaces", from(ratios..., &MedianOfRounds::rounds)}};
}

/// The quotients of two lists of times, round by round, as far as both reach.
[[nodiscard]] std::vector<double> round_ratios(std::span<const double> times, std::span<const double> others);

/// An interval of confidence, 95 %, for a share or for the difference of two.
struct ShareInterval {
  double lower = 0.0;  ///< lower end
  double upper = 1.0;  ///< upper end
};

/// Successes among independent trials.
struct ShareCount {
  std::size_t hits = 0;    ///< successes
  std::size_t trials = 0;  ///< at least `hits`
  /// hits / trials
  [[nodiscard]] double share() const { return static_cast<double>(hits) / static_cast<double>(trials); }
};

/// Wilson's interval for the share of a count: all shares π with |hits/n - π| <= z √(π(1 - π)/n). It needs at least
/// one trial, and fits small counts and shares near 0 and 1 as well.
[[nodiscard]] ShareInterval wilson_interval(const ShareCount& count);

/// Newcombe's interval for the difference of the shares of two counts, first less second, from Wilson's of each
/// ("Interval estimation for the difference between independent proportions", 1998, method 10).
[[nodiscard]] ShareInterval difference_interval(const ShareCount& first, const ShareCount& second);

}  // namespace dmocbench
