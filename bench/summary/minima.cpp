#include "bench/summary/minima.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bench/summary/share_interval.hpp"

namespace dmocbench {

namespace {

/// Rows that agree in these are compared: they differ in method and start only.
const ColumnNames group_columns{"problem", "tableau", "stages", "solver", "derivatives", "intervals"};

/// The minima that some solves ended in, each with its rows, the lowest cost first.
std::vector<Selection> minima_of(const Selection& rows, double separation) {
  std::vector<Selection> minima;
  double lowest = 0.0;
  for (const Row& row : rows.where("status", "solved").sorted_by("objective")) {
    const double objective = row.number("objective", 0.0);
    if (minima.empty() || objective - lowest > separation * std::abs(lowest)) {
      minima.emplace_back();
      lowest = objective;
    }
    minima.back().append(row);
  }
  return minima;
}

bool is_confirmed(const Selection& minimum, double confirmed_replay) {
  return std::ranges::any_of(
      minimum, [&](const Row& row) { return row.number("replay_error", confirmed_replay) < confirmed_replay; });
}

/// How many answers of a method are in minima that no replay confirms.
std::size_t unconfirmed_of(const std::vector<Selection>& minima, const std::string& method, double confirmed_replay) {
  std::size_t count = 0;
  for (const Selection& minimum : minima) {
    if (!is_confirmed(minimum, confirmed_replay)) count += minimum.where("method", method).size();
  }
  return count;
}

/// The lowest confirmed minimum; the end if there is none.
auto best_of(const std::vector<Selection>& minima, double confirmed_replay) {
  return std::ranges::find_if(minima,
                              [&](const Selection& minimum) { return is_confirmed(minimum, confirmed_replay); });
}

}  // namespace

Table distinct_minima(const Selection& rows, double separation, double confirmed_replay) {
  ColumnNames columns = group_columns;
  columns.insert(columns.end(), {"minimum", "objective", "is_best", "replay_confirmed"});
  const std::vector<std::string> methods = rows.distinct("method");
  columns.insert(columns.end(), methods.begin(), methods.end());
  Table table(columns);
  for (const Selection& group : rows.group_by(group_columns)) {
    const std::vector<Selection> minima = minima_of(group, separation);
    const auto best = best_of(minima, confirmed_replay);
    for (auto minimum = minima.begin(); minimum != minima.end(); ++minimum) {
      Row row = fields_of(group.front(), group_columns);
      row.set("minimum", minimum - minima.begin() + 1);
      row.set("objective", minimum->front().number("objective"));
      row.set("is_best", minimum == best ? "yes" : "no");
      row.set("replay_confirmed", is_confirmed(*minimum, confirmed_replay) ? "yes" : "no");
      for (const std::string& method : methods) row.set(method, minimum->where("method", method).size());
      table.append(std::move(row));
    }
  }
  return table;
}

Table best_minimum_shares(const Selection& rows, double separation, double confirmed_replay) {
  Table table({"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals", "starts", "solved",
               "unsolved", "unconfirmed", "best", "share", "share_lower", "share_upper"});
  const std::vector<std::string> methods = rows.distinct("method");
  for (const Selection& group : rows.group_by(group_columns)) {
    const std::vector<Selection> minima = minima_of(group, separation);
    const auto best = best_of(minima, confirmed_replay);
    for (const std::string& method : methods) {
      const Selection starts = group.where("method", method);
      if (starts.empty()) continue;
      const std::size_t hits = best == minima.end() ? 0 : best->where("method", method).size();
      const ShareCount count{.hits = hits, .trials = starts.size()};
      const ShareInterval interval = wilson_interval(count);
      Row row = fields_of(starts.front(), group_columns);
      row.set("method", method);
      row.set("starts", starts.size());
      row.set("solved", starts.where("status", "solved").size());
      row.set("unsolved", starts.size() - starts.where("status", "solved").size());
      row.set("unconfirmed", unconfirmed_of(minima, method, confirmed_replay));
      row.set("best", hits);
      row.set("share", count.share());
      row.set("share_lower", interval.lower);
      row.set("share_upper", interval.upper);
      table.append(std::move(row));
    }
  }
  return table;
}

}  // namespace dmocbench
