#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bench/report/results_folder.hpp"
#include "bench/tables/ratio_interval.hpp"

namespace dmocbench {

/// Rows of two tables that are about the same.
struct RowPair {
  std::string about;  ///< identity of both: "orbital_transfer dmoc gauss 1 ipopt tape 64"
  const Row* first = nullptr;
  const Row* second = nullptr;
};

/// The rows of two tables with the same fields in the key of the first one; where several of a table have the same, or
/// there is no key, the first belongs to the first, the second to the second. `alone` counts the rows without a
/// partner.
struct PairedRows {
  std::vector<RowPair> pairs;
  std::size_t alone = 0;
};
[[nodiscard]] PairedRows paired_rows(const Table& first, const Table& second);

/// A field that differs: a count or a status, which no rounding and no load of the machine change by itself.
struct ChangedField {
  std::string about;
  std::string column;
  std::string first;
  std::string second;
};
[[nodiscard]] std::vector<ChangedField> changed_fields(const Table& first, const Table& second, const PairedRows& rows);

/// The time of a solve in the second run by that in the first.
struct ChangedTime {
  std::string about;
  RatioInterval ratio;
  /// True if there are rounds enough for a verdict.
  [[nodiscard]] bool is_judged() const { return ratio.rounds >= fewest_rounds; }
  /// True if the interval does not contain 1 either.
  [[nodiscard]] bool is_changed() const { return is_judged() && (ratio.lower > 1.0 || ratio.upper < 1.0); }
};
/// The changed times of rows that were timed in rounds in both runs.
[[nodiscard]] std::vector<ChangedTime> changed_times(const PairedRows& rows);

}  // namespace dmocbench
