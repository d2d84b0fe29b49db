#include "bench/report/compared_tables.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <map>

#include "methods/runtime/parsed.hpp"

namespace dmocbench {

namespace {

/// Whole numbers that no run repeats, or that rounding decides.
bool is_no_count(const std::string& column) {
  return column.find("seconds") != std::string::npos || column == "jump_interval" || column == "message";
}

std::string about(const Row& row, const std::vector<std::string>& key) {
  std::string words;
  for (const std::string& column : key) {
    if (row.text(column).empty()) continue;
    words += (words.empty() ? "" : " ") + row.text(column);
  }
  return words;
}

/// The rows by their identity, and by their number among several of it.
std::map<std::pair<std::string, std::size_t>, const Row*> rows_by_key(const Table& table,
                                                                      const std::vector<std::string>& key) {
  std::map<std::pair<std::string, std::size_t>, const Row*> rows;
  std::map<std::string, std::size_t> counts;
  for (const Row& row : table.rows()) {
    const std::string words = about(row, key);
    rows[{words, counts[words]++}] = &row;
  }
  return rows;
}

bool is_count(const std::string& text) { return parsed<long long>(text).has_value(); }

/// Times of rounds; empty if the field holds something else.
std::vector<double> times_in(const Row& row) {
  try {
    return row.numbers("round_seconds");
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

PairedRows paired_rows(const Table& first, const Table& second) {
  std::vector<std::string> key;  // a column that only one of them has cannot identify rows
  std::ranges::copy_if(first.key(), std::back_inserter(key), [&second](const std::string& column) {
    return std::ranges::count(second.columns(), column) > 0;
  });
  const auto others = rows_by_key(second, key);
  PairedRows result;
  for (const auto& [identity, row] : rows_by_key(first, key)) {
    const auto other = others.find(identity);
    if (other != others.end()) result.pairs.push_back({identity.first, row, other->second});
  }
  result.alone = first.rows().size() + second.rows().size() - 2 * result.pairs.size();
  return result;
}

std::vector<ChangedField> changed_fields(const Table& first, const Table& second, const PairedRows& rows) {
  std::vector<ChangedField> changes;
  for (const std::string& column : first.columns()) {
    if (std::ranges::count(first.key(), column) > 0 || is_no_count(column) ||
        std::ranges::count(second.columns(), column) == 0)
      continue;
    for (const RowPair& pair : rows.pairs) {
      const std::string& before = pair.first->text(column);
      const std::string& after = pair.second->text(column);
      if (before == after) continue;
      const bool is_told = column == "status" || column == "verdict" || (is_count(before) && is_count(after));
      if (is_told) changes.push_back({pair.about, column, before, after});
    }
  }
  return changes;
}

std::vector<ChangedTime> changed_times(const PairedRows& rows) {
  std::vector<ChangedTime> times;
  for (const RowPair& pair : rows.pairs) {
    const std::vector<double> before = times_in(*pair.first);
    const std::vector<double> after = times_in(*pair.second);
    const auto is_time = [](double time) { return std::isfinite(time) && time > 0.0; };
    if (before.empty() || after.empty() || !std::ranges::all_of(before, is_time) ||
        !std::ranges::all_of(after, is_time))
      continue;
    times.push_back({pair.about, ratio_of_runs(after, before)});
  }
  return times;
}

}  // namespace dmocbench
