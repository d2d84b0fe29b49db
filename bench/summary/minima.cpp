#include "bench/summary/minima.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/summary/column_meanings.hpp"
#include "bench/summary/share_interval.hpp"
#include "methods/diagnostics/accuracy.hpp"

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

/// True if some answer has that number and it is at most the limit.
bool has_at_most(const Selection& minimum, const std::string& column, double limit) {
  return std::ranges::any_of(minimum.with_number(column),
                             [&](const Row& row) { return row.number(column, limit) <= limit; });
}

bool is_motion(const Selection& minimum) { return has_at_most(minimum, "relative_jump", largest_jump_of_a_motion); }

/// How many answers of a method are in minima that are no motion.
std::size_t unconfirmed_of(const std::vector<Selection>& minima, const std::string& method) {
  std::size_t count = 0;
  for (const Selection& minimum : minima) {
    if (!is_motion(minimum)) count += minimum.where("method", method).size();
  }
  return count;
}

/// The lowest minimum that is a motion; the end if there is none.
auto best_of(const std::vector<Selection>& minima) { return std::ranges::find_if(minima, is_motion); }

}  // namespace

Table distinct_minima(const Selection& rows, double separation) {
  ColumnNames columns = group_columns;
  columns.insert(columns.end(), {"minimum", "objective", "is_best", "is_motion", "replay_confirmed"});
  const std::vector<std::string> methods = rows.distinct("method");
  columns.insert(columns.end(), methods.begin(), methods.end());
  Table table(columns);
  explain(table, meanings_in_minima());
  for (const std::string& method : methods) {
    table.explain({{method, "how often this method ended there"}});
    table.declare({{method, {FieldKind::integer, false}}});
  }
  for (const Selection& group : rows.group_by(group_columns)) {
    const std::vector<Selection> minima = minima_of(group, separation);
    const auto best = best_of(minima);
    for (auto minimum = minima.begin(); minimum != minima.end(); ++minimum) {
      Row row = fields_of(group.front(), group_columns);
      row.set("minimum", minimum - minima.begin() + 1);
      row.set("objective", minimum->front().number("objective"));
      row.set("is_best", minimum == best ? "yes" : "no");
      row.set("is_motion", is_motion(*minimum) ? "yes" : "no");
      row.set("replay_confirmed", has_at_most(*minimum, "replay_error", confirmed_replay) ? "yes" : "no");
      for (const std::string& method : methods) row.set(method, minimum->where("method", method).size());
      table.append(std::move(row));
    }
  }
  return table;
}

Table basins(const Selection& rows, double separation) {
  const ColumnNames columns{"problem", "method",  "tableau", "stages",  "solver",    "derivatives", "intervals",
                            "bulge_1", "bulge_2", "status",  "minimum", "objective", "is_motion"};
  const ColumnNames copied(columns.begin(), columns.end() - 3);
  Table table(columns);
  explain(table, meanings_in_minima());
  for (const Selection& group : rows.group_by(group_columns)) {
    const std::vector<Selection> minima = minima_of(group, separation);
    std::vector<Row> starts;
    for (std::size_t i = 0; i < minima.size(); ++i) {
      for (const Row& answer : minima[i]) {
        Row& row = starts.emplace_back(fields_of(answer, copied));
        row.set("minimum", i + 1);
        row.set("objective", minima[i].front().number("objective"));
        row.set("is_motion", is_motion(minima[i]) ? "yes" : "no");
      }
    }
    for (const Row& answer : group) {
      if (answer.text("status") != "solved") starts.push_back(fields_of(answer, copied));
    }
    // Line by line of the plane, as an image is drawn.
    std::ranges::stable_sort(starts, {}, [](const Row& row) {
      return std::tuple(row.text("method"), row.needed("bulge_2"), row.needed("bulge_1"));
    });
    for (Row& start : starts) table.append(std::move(start));
  }
  return table;
}

Table best_minimum_shares(const Selection& rows, double separation) {
  Table table({"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals", "starts", "solved",
               "unsolved", "unconfirmed", "best", "share", "share_lower", "share_upper"});
  explain(table, meanings_in_minima());
  const std::vector<std::string> methods = rows.distinct("method");
  for (const Selection& group : rows.group_by(group_columns)) {
    const std::vector<Selection> minima = minima_of(group, separation);
    const auto best = best_of(minima);
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
      row.set("unconfirmed", unconfirmed_of(minima, method));
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
