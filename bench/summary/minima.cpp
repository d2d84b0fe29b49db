#include "bench/summary/minima.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dmocbench {

namespace {

/// Rows that are compared with each other: they differ in method and start only.
using Group = std::array<std::string, 6>;

constexpr std::array group_columns{"problem", "tableau", "stages", "solver", "derivatives", "intervals"};

Group group_of(const Row& row) {
  Group group;
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = row.text(group_columns[i]);
  return group;
}

Row head_of(const Group& group) {
  Row row;
  for (std::size_t i = 0; i < group.size(); ++i) row.set(group_columns[i], group[i]);
  return row;
}

/// A minimum: the answers that ended there.
struct Minimum {
  double objective = 0.0;                  // the lowest of them
  bool confirmed = false;                  // by a replay
  std::map<std::string, long long> count;  // per method

  [[nodiscard]] long long ended_by(const std::string& method) const {
    const auto found = count.find(method);
    return found == count.end() ? 0 : found->second;
  }
};

std::vector<Minimum> minima_of(const std::vector<const Row*>& rows, double separation, double confirmed_replay) {
  std::vector<std::pair<double, const Row*>> answers;  // cost and row
  for (const Row* row : rows) {
    const auto objective = row->number("objective");
    if (row->text("status") == "solved" && objective) answers.emplace_back(*objective, row);
  }
  std::sort(answers.begin(), answers.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Minimum> minima;
  for (const auto& [objective, row] : answers) {
    const bool is_new =
        minima.empty() || objective - minima.back().objective > separation * std::abs(minima.back().objective);
    if (is_new) minima.push_back({.objective = objective, .confirmed = false, .count = {}});
    ++minima.back().count[row->text("method")];
    const auto replay = row->number("replay_error");
    minima.back().confirmed = minima.back().confirmed || (replay && *replay < confirmed_replay);
  }
  return minima;
}

/// The best one's number; that of none if no replay confirms any.
std::size_t best_of(const std::vector<Minimum>& minima) {
  const auto found = std::find_if(minima.begin(), minima.end(), [](const Minimum& m) { return m.confirmed; });
  return static_cast<std::size_t>(found - minima.begin());
}

std::map<Group, std::vector<const Row*>> grouped(const Table& rows) {
  std::map<Group, std::vector<const Row*>> groups;
  for (const Row& row : rows.rows()) groups[group_of(row)].push_back(&row);
  return groups;
}

std::vector<std::string> methods_in(const Table& rows) {
  std::vector<std::string> methods;
  for (const Row& row : rows.rows()) {
    const std::string method = row.text("method");
    if (std::find(methods.begin(), methods.end(), method) == methods.end()) methods.push_back(method);
  }
  return methods;
}

}  // namespace

Table distinct_minima(const Table& rows, double separation, double confirmed_replay) {
  std::vector<std::string> columns{"problem",   "tableau", "stages",    "solver",  "derivatives",
                                   "intervals", "minimum", "objective", "is_best", "replay_confirmed"};
  const std::vector<std::string> methods = methods_in(rows);
  columns.insert(columns.end(), methods.begin(), methods.end());
  Table table(columns);
  for (const auto& [group, members] : grouped(rows)) {
    const std::vector<Minimum> minima = minima_of(members, separation, confirmed_replay);
    const std::size_t best = best_of(minima);
    for (std::size_t i = 0; i < minima.size(); ++i) {
      Row row = head_of(group);
      row.set("minimum", static_cast<long long>(i + 1));
      row.set("objective", minima[i].objective);
      row.set("is_best", i == best ? "yes" : "no");
      row.set("replay_confirmed", minima[i].confirmed ? "yes" : "no");
      for (const std::string& method : methods) row.set(method, minima[i].ended_by(method));
      table.append(std::move(row));
    }
  }
  return table;
}

Table best_minimum_shares(const Table& rows, double separation, double confirmed_replay) {
  Table table({"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals", "starts", "solved",
               "best", "share", "share_lower", "share_upper"});
  for (const auto& [group, members] : grouped(rows)) {
    const std::vector<Minimum> minima = minima_of(members, separation, confirmed_replay);
    const std::size_t best = best_of(minima);
    for (const std::string& method : methods_in(rows)) {
      const auto of_method = [&](const Row* row) { return row->text("method") == method; };
      const long long starts = std::count_if(members.begin(), members.end(), of_method);
      if (starts == 0) continue;
      const long long solved = std::count_if(members.begin(), members.end(), [&](const Row* row) {
        return of_method(row) && row->text("status") == "solved";
      });
      const long long hits = best < minima.size() ? minima[best].ended_by(method) : 0;
      const ShareInterval interval = wilson_interval(hits, starts);
      Row row = head_of(group);
      row.set("method", method);
      row.set("starts", starts);
      row.set("solved", solved);
      row.set("best", hits);
      row.set("share", static_cast<double>(hits) / static_cast<double>(starts));
      row.set("share_lower", interval.lower);
      row.set("share_upper", interval.upper);
      table.append(std::move(row));
    }
  }
  return table;
}

ShareInterval wilson_interval(long long hits, long long trials) {
  constexpr double z = 1.959963984540054;  // 97.5 % of a normal distribution lie below
  const auto n = static_cast<double>(trials);
  const double share = static_cast<double>(hits) / n;
  const double centre = share + z * z / (2.0 * n);
  const double half_width = z * std::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
  const double norm = 1.0 + z * z / n;
  return {std::max(0.0, (centre - half_width) / norm), std::min(1.0, (centre + half_width) / norm)};
}

}  // namespace dmocbench
