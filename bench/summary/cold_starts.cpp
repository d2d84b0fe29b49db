#include "bench/summary/cold_starts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bench/summary/column_meanings.hpp"
#include "bench/summary/share_interval.hpp"
#include "methods/numerics/quantile.hpp"

namespace dmocbench {

namespace {

const ColumnNames grid_columns{"problem", "tableau", "stages", "intervals"};
const ColumnNames columns_of_competitors{"method", "tableau", "stages", "solver", "derivatives", "intervals"};
const ColumnNames cell_columns{"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals"};

/// Every row of the tables says so itself.
constexpr const char* start_kind = "cold";

bool was_confirmed(const Row& row) { return row.text("status") == "solved"; }
bool was_too_coarse(const Row& row) { return row.text("status") == "too coarse"; }

/// The cost that tells which answers are the best.
struct BestCost {
  std::optional<double> cost;  ///< none if nothing is confirmed
  const char* kind = "none";

  BestCost(const Selection& grid, double tolerance) {
    const Selection confirmed = grid.where(was_confirmed);
    if (confirmed.empty()) return;
    const double lowest = confirmed.min("objective");
    const auto certified = grid.front().number("reference_objective");
    const bool is_reached = certified && lowest - *certified <= tolerance * std::abs(*certified);
    cost = is_reached ? *certified : lowest;
    kind = is_reached ? "certified" : "lowest confirmed";
  }
  /// How far a cost is above, relative.
  [[nodiscard]] double excess(const Row& row) const {
    return (row.needed("objective") - cost.value_or(0.0)) / std::abs(cost.value_or(1.0));
  }
};

std::vector<double> sorted_numbers(const Selection& rows, const std::string& column) {
  std::vector<double> numbers;
  for (const Row& row : rows.with_number(column).sorted_by(column)) numbers.push_back(row.needed(column));
  return numbers;
}

/// A column of the shares, and the column of the solves that it summarises.
struct Effort {
  const char* name;
  const char* column;
};
constexpr std::array efforts{Effort{"iterations", "major_iterations"}, Effort{"evaluations", "evaluations"},
                             Effort{"seconds", "seconds"}};
constexpr std::array quartiles{std::pair{"_lower_quartile", 0.25}, std::pair{"_median", 0.5},
                               std::pair{"_upper_quartile", 0.75}};
constexpr std::array counted{"solved", "confirmed", "best"};

ColumnNames share_columns() {
  ColumnNames columns = cell_columns;
  columns.insert(columns.end(), {"start_kind", "starts"});
  for (const std::string what : counted) {
    columns.insert(columns.end(), {what, what + "_share", what + "_lower", what + "_upper"});
  }
  columns.insert(columns.end(), {"elsewhere", "too_coarse", "lost", "failures", "below_reference",
                                 "certified_objective", "reference_objective", "reference_kind"});
  for (const Effort& effort : efforts) {
    for (const auto& [suffix, share] : quartiles) columns.push_back(std::string(effort.name) + suffix);
  }
  return columns;
}

void set_share(Row& row, const std::string& what, const ShareCount& count) {
  const ShareInterval interval = wilson_interval(count);
  row.set(what, count.hits);
  row.set(what + "_share", count.share());
  row.set(what + "_lower", interval.lower);
  row.set(what + "_upper", interval.upper);
}

/// "iteration limit 12, step failed 3".
std::string failures_in_words(const Selection& lost) {
  std::vector<std::string> parts;
  for (const Selection& alike : lost.group_by({"status"})) {
    parts.push_back(fmt::format("{} {}", alike.front().text("status"), alike.size()));
  }
  std::ranges::sort(parts);
  return fmt::format("{}", fmt::join(parts, ", "));
}

Row shares_of(const Selection& cell, const BestCost& reference, double tolerance) {
  const std::size_t starts = cell.size();
  const Selection confirmed = cell.where(was_confirmed);
  const Selection best = confirmed.where([&](const Row& row) { return reference.excess(row) <= tolerance; });
  const Selection below = best.where([&](const Row& row) { return reference.excess(row) < -tolerance; });
  const Selection lost = cell.where([](const Row& row) { return !was_confirmed(row) && !was_too_coarse(row); });
  Row row = fields_of(cell.front(), cell_columns);
  row.set("start_kind", start_kind);
  row.set("starts", starts);
  set_share(row, "solved", {.hits = starts - lost.size(), .trials = starts});
  set_share(row, "confirmed", {.hits = confirmed.size(), .trials = starts});
  set_share(row, "best", {.hits = best.size(), .trials = starts});
  row.set("elsewhere", confirmed.size() - best.size());
  row.set("too_coarse", starts - lost.size() - confirmed.size());
  row.set("lost", lost.size());
  row.set("failures", failures_in_words(lost));
  row.set("below_reference", below.size());
  row.set("certified_objective", cell.front().number("reference_objective"));
  row.set("reference_objective", reference.cost);
  row.set("reference_kind", reference.kind);
  for (const Effort& effort : efforts) {
    const std::vector<double> taken = sorted_numbers(best, effort.column);
    for (const auto& [suffix, share] : quartiles) row.set(std::string(effort.name) + suffix, quantile(taken, share));
  }
  return row;
}

/// The efforts of the confirmed answers of a cell, sorted, and how many starts it had.
struct Curve {
  Row cell;
  std::vector<double> taken;
  std::size_t starts = 0;
  [[nodiscard]] double share_within(double budget) const {
    const auto within = std::ranges::upper_bound(taken, budget) - taken.begin();
    return static_cast<double>(within) / static_cast<double>(starts);
  }
};

std::vector<Curve> curves_of(const Selection& rows, const std::string& measure) {
  std::vector<Curve> curves;
  for (const Selection& cell : rows.group_by(cell_columns)) {
    curves.push_back({.cell = fields_of(cell.front(), cell_columns),
                      .taken = sorted_numbers(cell.where(was_confirmed), measure),
                      .starts = cell.size()});
  }
  return curves;
}

constexpr std::size_t most_points = 100;

/// Evenly many of the steps of some curves together, the first and the last among them.
std::vector<double> budgets_of(const std::vector<Curve>& curves) {
  std::vector<double> all;
  for (const Curve& curve : curves) all.insert(all.end(), curve.taken.begin(), curve.taken.end());
  std::ranges::sort(all);
  const auto repeated = std::ranges::unique(all);
  all.erase(repeated.begin(), repeated.end());
  if (all.size() <= most_points) return all;
  std::vector<double> budgets;
  budgets.reserve(most_points);
  for (std::size_t i = 0; i < most_points; ++i) budgets.push_back(all[i * (all.size() - 1) / (most_points - 1)]);
  return budgets;
}

void append_profile(Table& table, const Row& cell, const std::string& measure, double budget, double share) {
  Row row = cell;
  row.set("start_kind", start_kind);
  row.set("measure", measure);
  row.set("budget", budget);
  row.set("share", share);
  table.append(std::move(row));
}

void append_profiles_of_problems(Table& table, const Selection& rows, const std::string& measure) {
  for (const Selection& of_solver : rows.group_by({"problem", "solver"})) {
    const std::vector<Curve> curves = curves_of(of_solver, measure);
    const std::vector<double> budgets = budgets_of(curves);
    for (const Curve& curve : curves) {
      for (const double budget : budgets)
        append_profile(table, curve.cell, measure, budget, curve.share_within(budget));
    }
  }
}

/// The means over the problems, of solvers that worked on several.
void append_profiles_of_all(Table& table, const Selection& rows, const std::string& measure) {
  for (const Selection& of_solver : rows.group_by({"solver"})) {
    if (of_solver.distinct("problem").size() < 2) continue;
    const std::vector<double> budgets = budgets_of(curves_of(of_solver, measure));
    for (const Selection& competitor : of_solver.group_by(columns_of_competitors)) {
      const std::vector<Curve> curves = curves_of(competitor, measure);
      Row cell = fields_of(competitor.front(), columns_of_competitors);
      cell.set("problem", every_problem);
      for (const double budget : budgets) {
        double sum = 0.0;
        for (const Curve& curve : curves) sum += curve.share_within(budget);
        append_profile(table, cell, measure, budget, sum / static_cast<double>(curves.size()));
      }
    }
  }
}

}  // namespace

Table cold_start_shares(const Selection& rows, double tolerance) {
  Table table(share_columns());
  explain(table, meanings_in_cold_starts());
  for (const Selection& grid : rows.group_by(grid_columns)) {
    const BestCost reference(grid, tolerance);
    for (const Selection& cell : grid.group_by(cell_columns)) table.append(shares_of(cell, reference, tolerance));
  }
  return table;
}

Table cold_start_profiles(const Selection& rows) {
  ColumnNames columns = cell_columns;
  columns.insert(columns.end(), {"start_kind", "measure", "budget", "share"});
  Table table(columns);
  explain(table, meanings_in_cold_starts());
  for (const std::string measure : {"evaluations", "seconds"}) {
    append_profiles_of_problems(table, rows, measure);
    append_profiles_of_all(table, rows, measure);
  }
  return table;
}

}  // namespace dmocbench
