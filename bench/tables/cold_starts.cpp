#include "bench/tables/cold_starts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bench/run/column.hpp"
#include "bench/run/solve_case.hpp"
#include "bench/tables/ratio_interval.hpp"
#include "methods/numerics/quantile.hpp"
#include "methods/program/status.hpp"

namespace dmocbench {

namespace {

const ColumnNames grid_columns{"problem", "tableau", "stages", "intervals"};
const ColumnNames columns_of_competitors{"method", "tableau", "stages", "solver", "derivatives", "intervals"};
const ColumnNames cell_columns{"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals"};

bool was_no_motion(const Row& row) { return is_no_motion(status_named(row.text("status"))); }

/// The cost by which answers count as the best.
struct BestCost {
  std::optional<double> cost;  ///< empty if no answer is confirmed
  const char* kind = "none";

  BestCost(const Selection& grid, double tolerance) {
    const Selection confirmed = grid.where(has_solved_status);
    if (confirmed.empty()) return;
    const double lowest = confirmed.min("objective");
    const auto certified = grid.front().number("reference_objective");
    const bool is_reached = certified && lowest - *certified <= tolerance * std::abs(*certified);
    cost = is_reached ? *certified : lowest;
    kind = is_reached ? "certified" : "lowest confirmed";
  }
  /// The relative excess of a cost.
  [[nodiscard]] double excess(const Row& row) const {
    const double difference = row.needed("objective") - cost.value_or(0.0);
    return difference == 0.0 ? 0.0 : difference / std::abs(cost.value_or(1.0));
  }
};

std::vector<double> sorted_numbers(const Selection& rows, const std::string& column) {
  std::vector<double> numbers;
  for (const Row& row : rows.with_number(column).sorted_by(column)) numbers.push_back(row.needed(column));
  return numbers;
}

/// A column of the shares, the column of the solves that it summarises, and its meaning.
struct Effort {
  const char* name;
  const char* column;
  const char* unit;
  const char* meaning;
};
constexpr std::array efforts{
    Effort{"iterations", "major_iterations", "", "major iterations of the best solutions"},
    Effort{"evaluations", "evaluations", "", "evaluations of derivatives for the best solutions"},
    Effort{"seconds", "seconds", "s", "time of the best solutions"}};
constexpr std::array quartiles{std::pair{"_lower_quartile", 0.25}, std::pair{"_median", 0.5},
                               std::pair{"_upper_quartile", 0.75}};

/// The outcomes of the starts of a cell.
struct EndsOfCell {
  Row head;
  ShareCount solved;
  ShareCount confirmed;
  ShareCount best;
  std::size_t lost = 0;
  std::string failures;
  std::size_t below_reference = 0;
  BestCost reference;
  std::array<std::vector<double>, efforts.size()> taken = {};  ///< by the best answers, sorted
};

/// NAME, NAME_share, NAME_lower and NAME_upper.
Columns<EndsOfCell> share_columns(const std::string& name, const std::string& meaning, ShareCount EndsOfCell::*count) {
  return {{name, "", meaning, from(count, &ShareCount::hits)},
          {name + "_share", "", "share of all starts", from(count, &ShareCount::share)},
          {name + "_lower", "", "lower limit of Wilson's 95 % confidence interval of the share",
           from(count, wilson_interval, &ShareInterval::lower)},
          {name + "_upper", "", "upper 95 % limit of the share", from(count, wilson_interval, &ShareInterval::upper)}};
}

/// A column of every row of the tables.
template <class Record>
Column<Record> start_kind_column() {
  return {"start_kind", "", "kind of start of the solves", [](const Record& /*record*/) { return "cold"; }, in_key};
}

Columns<EndsOfCell> columns_of_ends() {
  using Ends = EndsOfCell;
  Columns<Ends> columns =
      head_columns<Ends>(cell_columns, in_key) +
      Columns<Ends>{start_kind_column<Ends>(),
                    {"starts", "", "number of starts", from(&Ends::solved, &ShareCount::trials)}} +
      share_columns("solved", "number of starts that ended at a confirmed optimum of the discrete program",
                    &Ends::solved) +
      share_columns("confirmed", "number of solved starts whose intervals, integrated one by one, reach the next node",
                    &Ends::confirmed) +
      share_columns("best", "number of confirmed starts whose cost does not exceed the reference within the tolerance",
                    &Ends::best) +
      Columns<Ends>{
          {"elsewhere", "", "number of confirmed starts whose cost exceeds the reference",
           [](const Ends& ends) { return ends.confirmed.hits - ends.best.hits; }},
          {"too_coarse", "", "number of solved starts whose grid is too coarse",
           [](const Ends& ends) { return ends.solved.hits - ends.confirmed.hits; }},
          {"lost", "", "number of unsolved starts", &Ends::lost},
          {"failures", "", "statuses of the unsolved starts, each with its count", &Ends::failures},
          {"below_reference", "", "number of best starts whose cost is below the reference", &Ends::below_reference},
          {"certified_objective", "cost", "certified optimum of the problem, if known",
           [](const Ends& ends) { return ends.head.number("reference_objective"); }},
          {"reference_objective", "cost", "reference: the cost with which solutions are compared",
           from(&Ends::reference, &BestCost::cost)},
          {"reference_kind", "", "reference: certified, or the lowest confirmed cost on the grid",
           from(&Ends::reference, &BestCost::kind)}};
  for (std::size_t i = 0; i < efforts.size(); ++i) {
    for (const auto& [suffix, share] : quartiles) {
      columns.push_back({std::string(efforts[i].name) + suffix, efforts[i].unit, efforts[i].meaning,
                         [i, at = share](const Ends& ends) { return quantile(ends.taken[i], at); }});
    }
  }
  return columns;
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

EndsOfCell ends_of(const Selection& cell, const BestCost& reference, double tolerance) {
  const std::size_t starts = cell.size();
  const Selection confirmed = cell.where(has_solved_status);
  const Selection best = confirmed.where([&](const Row& row) { return reference.excess(row) <= tolerance; });
  const Selection below = best.where([&](const Row& row) { return reference.excess(row) < -tolerance; });
  const Selection lost = cell.where([](const Row& row) { return !has_solved_status(row) && !was_no_motion(row); });
  EndsOfCell ends{.head = cell.front(),
                  .solved = {.hits = starts - lost.size(), .trials = starts},
                  .confirmed = {.hits = confirmed.size(), .trials = starts},
                  .best = {.hits = best.size(), .trials = starts},
                  .lost = lost.size(),
                  .failures = failures_in_words(lost),
                  .below_reference = below.size(),
                  .reference = reference};
  for (std::size_t i = 0; i < efforts.size(); ++i) ends.taken[i] = sorted_numbers(best, efforts[i].column);
  return ends;
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
                      .taken = sorted_numbers(cell.where(has_solved_status), measure),
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

/// A point of a profile of budgets.
struct BudgetPoint {
  Row head;
  std::string measure;
  double budget = 0.0;
  double share = 0.0;
};

Columns<BudgetPoint> profile_columns() {
  return head_columns<BudgetPoint>(cell_columns, in_key) +
         Columns<BudgetPoint>{
             start_kind_column<BudgetPoint>(),
             {"measure", "", "unit of the budget: evaluations or seconds", &BudgetPoint::measure, in_key},
             {"budget", "", "largest number of evaluations, or of seconds, that a solve may take", &BudgetPoint::budget,
              in_key},
             {"share", "", "share of all starts that are solved and confirmed within the budget", &BudgetPoint::share}};
}

void append_profiles_of_problems(std::vector<BudgetPoint>& points, const Selection& rows, const std::string& measure) {
  for (const Selection& of_solver : rows.group_by({"problem", "solver"})) {
    const std::vector<Curve> curves = curves_of(of_solver, measure);
    const std::vector<double> budgets = budgets_of(curves);
    for (const Curve& curve : curves) {
      for (const double budget : budgets) points.push_back({curve.cell, measure, budget, curve.share_within(budget)});
    }
  }
}

/// The means over the problems, of solvers that worked on several.
void append_profiles_of_all(std::vector<BudgetPoint>& points, const Selection& rows, const std::string& measure) {
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
        points.push_back({cell, measure, budget, sum / static_cast<double>(curves.size())});
      }
    }
  }
}

}  // namespace

Table cold_start_shares(const Selection& rows, double tolerance) {
  std::vector<EndsOfCell> all;
  for (const Selection& grid : rows.group_by(grid_columns)) {
    const BestCost reference(grid, tolerance);
    for (const Selection& cell : grid.group_by(cell_columns)) all.push_back(ends_of(cell, reference, tolerance));
  }
  return table_of(columns_of_ends(), all);
}

Table cold_start_profiles(const Selection& rows) {
  std::vector<BudgetPoint> points;
  for (const std::string measure : {"evaluations", "seconds"}) {
    append_profiles_of_problems(points, rows, measure);
    append_profiles_of_all(points, rows, measure);
  }
  return table_of(profile_columns(), points);
}

}  // namespace dmocbench
