#include "bench/summary/performance_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace dmocbench {

namespace {

constexpr double smallest_effort = 1e-9;  // below it efforts are alike
constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::array competitor_columns{"method", "tableau", "stages", "solver", "derivatives"};

/// A column that every solved row has.
constexpr const char* always_told = "objective";

using Competitor = std::array<std::string, competitor_columns.size()>;
using Instance = std::pair<std::string, std::string>;  // problem, intervals

/// What every competitor takes on every instance, by one measure; `never` where it failed, has no row or does not tell.
struct Contest {
  std::vector<Competitor> competitors;  // in the order of the rows
  std::vector<Instance> instances;
  std::vector<std::vector<double>> taken;  // competitor, instance

  [[nodiscard]] double best(std::size_t instance) const {
    double least = never;
    for (const auto& values : taken) least = std::min(least, values[instance]);
    return least;
  }
  [[nodiscard]] bool solved_by_all(std::size_t instance) const {
    return std::all_of(taken.begin(), taken.end(),
                       [&](const std::vector<double>& values) { return values[instance] < never; });
  }
};

template <class Value>
std::size_t index_in(std::vector<Value>& values, const Value& value) {
  const auto found = std::find(values.begin(), values.end(), value);
  if (found != values.end()) return static_cast<std::size_t>(found - values.begin());
  values.push_back(value);
  return values.size() - 1;
}

Contest contest_of(const Table& rows, const std::string& measure) {
  Contest contest;
  std::map<std::pair<std::size_t, std::size_t>, double> taken;
  for (const Row& row : rows.rows()) {
    Competitor competitor;
    for (std::size_t i = 0; i < competitor.size(); ++i) competitor[i] = row.text(competitor_columns[i]);
    const std::size_t who = index_in(contest.competitors, competitor);
    const std::size_t where = index_in(contest.instances, Instance{row.text("problem"), row.text("intervals")});
    const auto value = row.number(measure);
    taken[{who, where}] = row.text("success") == "yes" && value ? *value : never;
  }
  contest.taken.assign(contest.competitors.size(), std::vector<double>(contest.instances.size(), never));
  for (const auto& [place, value] : taken) contest.taken[place.first][place.second] = value;
  return contest;
}

/// x / y where both may be 0, as counts can.
double ratio(double x, double y) { return x == y ? 1.0 : x / std::max(y, smallest_effort); }

void set_competitor(Row& row, const Competitor& competitor) {
  for (std::size_t i = 0; i < competitor.size(); ++i) row.set(competitor_columns[i], competitor[i]);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The instances that everyone solved.
std::vector<std::size_t> common_instances(const Contest& contest) {
  std::vector<std::size_t> common;
  for (std::size_t i = 0; i < contest.instances.size(); ++i) {
    if (contest.solved_by_all(i)) common.push_back(i);
  }
  return common;
}

std::optional<double> shifted_geometric_mean(const std::vector<double>& values, const std::vector<std::size_t>& picked,
                                             double shift) {
  if (picked.empty()) return std::nullopt;
  double sum = 0.0;
  for (const std::size_t i : picked) sum += std::log(values[i] + shift);
  return std::exp(sum / static_cast<double>(picked.size())) - shift;
}

/// Means and wins by one measure.
void set_measure(const Contest& contest, const std::string& measure, const std::vector<std::size_t>& common,
                 std::vector<Row>& summary) {
  std::vector<double> all;
  for (const auto& values : contest.taken) {
    for (const std::size_t i : common) {
      if (values[i] < never) all.push_back(values[i]);
    }
  }
  const double shift = median(all);
  for (std::size_t who = 0; who < summary.size(); ++who) {
    const std::vector<double>& values = contest.taken[who];
    const bool tells = std::all_of(common.begin(), common.end(), [&](std::size_t i) { return values[i] < never; });
    if (tells) summary[who].set(measure, shifted_geometric_mean(values, common, shift));
    long long wins = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] < never && values[i] == contest.best(i)) ++wins;
    }
    summary[who].set("wins_" + measure, wins);
  }
}

}  // namespace

const std::vector<std::string>& profile_measures() {
  static const std::vector<std::string> measures{"seconds", "evaluations", "major_iterations"};
  return measures;
}

Table performance_profiles(const Table& rows) {
  Table table({"measure", "method", "tableau", "stages", "solver", "derivatives", "ratio", "share"});
  for (const std::string& measure : profile_measures()) {
    const Contest contest = contest_of(rows, measure);
    std::vector<std::vector<double>> ratios(contest.competitors.size());
    double largest = 1.0;
    for (std::size_t i = 0; i < contest.instances.size(); ++i) {
      const double best = contest.best(i);
      for (std::size_t who = 0; who < ratios.size() && best < never; ++who) {
        const double taken = contest.taken[who][i];
        if (taken == never) continue;
        ratios[who].push_back(ratio(taken, best));
        largest = std::max(largest, ratios[who].back());
      }
    }
    for (std::size_t who = 0; who < ratios.size(); ++who) {
      std::vector<double>& steps = ratios[who];
      std::sort(steps.begin(), steps.end());
      const auto point = [&](double at) {
        const auto below = std::upper_bound(steps.begin(), steps.end(), at) - steps.begin();
        Row row;
        row.set("measure", measure);
        set_competitor(row, contest.competitors[who]);
        row.set("ratio", at);
        row.set("share", static_cast<double>(below) / static_cast<double>(contest.instances.size()));
        table.append(std::move(row));
      };
      point(1.0);
      for (const double step : steps) {
        if (step > 1.0) point(step);
      }
      point(largest);
    }
  }
  return table;
}

Table profile_summary(const Table& rows) {
  std::vector<std::string> columns(competitor_columns.begin(), competitor_columns.end());
  columns.insert(columns.end(), {"instances", "successes", "common"});
  for (const std::string& measure : profile_measures()) columns.insert(columns.end(), {measure, "wins_" + measure});
  Table table(columns);
  // Who succeeded where does not depend on what is measured.
  const Contest successes = contest_of(rows, always_told);
  const std::vector<std::size_t> common = common_instances(successes);
  std::vector<Row> summary(successes.competitors.size());
  for (std::size_t who = 0; who < summary.size(); ++who) {
    const std::vector<double>& values = successes.taken[who];
    set_competitor(summary[who], successes.competitors[who]);
    summary[who].set("instances", static_cast<long long>(values.size()));
    summary[who].set("successes", static_cast<long long>(std::count_if(values.begin(), values.end(),
                                                                       [](double taken) { return taken < never; })));
    summary[who].set("common", static_cast<long long>(common.size()));
  }
  for (const std::string& measure : profile_measures())
    set_measure(contest_of(rows, measure), measure, common, summary);
  for (Row& row : summary) table.append(std::move(row));
  return table;
}

}  // namespace dmocbench
