#include "bench/tables/minima.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "bench/run/column.hpp"
#include "bench/run/solve_case.hpp"
#include "bench/tables/ratio_interval.hpp"
#include "methods/diagnostics/accuracy.hpp"

namespace dmocbench {

namespace {

/// Rows that agree in these are compared: they differ in method, start and grid only.
const ColumnNames columns_of_all_grids{"problem", "tableau", "stages", "solver", "derivatives"};
/// Rows that agree in these differ in method and start only.
const ColumnNames group_columns{"problem", "tableau", "stages", "solver", "derivatives", "intervals"};

/// The part of a cost that the grid makes: how far it is from the cost of the same motion, interval by interval.
double grid_error(const Row& row) {
  const double objective = row.number("objective", 0.0);
  return std::abs(row.number("interval_cost", objective) - objective);
}

/// The minima that some solves ended in, each with its rows, the lowest cost first.
std::vector<Selection> minima_of(const Selection& rows, double separation) {
  std::vector<Selection> minima;
  double lowest = 0.0;
  double error_of_lowest = 0.0;
  for (const Row& row : rows.where(has_solved_status).sorted_by("objective")) {
    const double objective = row.number("objective", 0.0);
    const double errors = error_of_lowest + grid_error(row);
    if (minima.empty() || objective - lowest > separation * std::abs(lowest) + errors) {
      minima.emplace_back();
      lowest = objective;
      error_of_lowest = grid_error(row);
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

/// The number of answers of a method in minima that are not motions.
std::size_t unconfirmed_of(const std::vector<Selection>& minima, const std::string& method) {
  std::size_t count = 0;
  for (const Selection& minimum : minima) {
    if (!is_motion(minimum)) count += minimum.where("method", method).size();
  }
  return count;
}

/// The lowest answer of the best minimum on the finest grid that has one: the lowest minimum that is a motion. `row` is
/// of any grid. Empty if no grid has one.
std::optional<Row> finest_best(const Selection& rows, const Row& row, double separation) {
  std::vector<Selection> grids = rows.matching(row, columns_of_all_grids).group_by({"intervals"});
  std::ranges::sort(grids, std::greater(), [](const Selection& grid) { return grid.front().number("intervals", 0.0); });
  for (const Selection& grid : grids) {
    const std::vector<Selection> minima = minima_of(grid, separation);
    const auto best = std::ranges::find_if(minima, is_motion);
    if (best != minima.end()) return best->front();
  }
  return std::nullopt;
}

/// Among the minima of a grid the one that is the best minimum of the finest grid, or the end: the motion whose cost is
/// nearest to it, within the separation and the grid errors of both.
auto best_of(const std::vector<Selection>& minima, const std::optional<Row>& finest, double separation) {
  auto best = minima.end();
  if (!finest) return best;
  const double wanted = finest->needed("objective");
  double least = std::numeric_limits<double>::infinity();
  for (auto minimum = minima.begin(); minimum != minima.end(); ++minimum) {
    const Row& lowest = minimum->front();
    const double distance = std::abs(lowest.needed("objective") - wanted);
    const double permitted = separation * std::abs(wanted) + grid_error(lowest) + grid_error(*finest);
    if (!is_motion(*minimum) || distance > permitted || distance >= least) continue;
    least = distance;
    best = minimum;
  }
  return best;
}

/// A minimum among the answers of all methods, and the answers that ended there.
struct Minimum {
  Row head;
  std::size_t number = 0;
  Selection answers;
  bool is_best = false;

  [[nodiscard]] double objective() const { return answers.front().needed("objective"); }
};

const char* is_motion_in_words(const Selection& minimum) { return yes_or_no(is_motion(minimum)); }

Columns<Minimum> minimum_columns(const std::vector<std::string>& methods) {
  const auto found_by = [&](std::size_t i) {
    return [method = methods[i]](const Minimum& minimum) { return minimum.answers.where("method", method).size(); };
  };
  return head_columns<Minimum>(group_columns, in_key) +
         Columns<Minimum>{
             {"minimum", "", "number of the minimum, from the lowest cost upwards", &Minimum::number, in_key},
             {"objective", "cost", "lowest cost of all solutions at this minimum", &Minimum::objective},
             {"is_best", "",
              "yes for the lowest minimum on the finest grid that is not too coarse, and for the same minimum on other "
              "grids",
              from(&Minimum::is_best, yes_or_no)},
             {"is_motion", "", "yes if the intervals of a solution, integrated one by one, reach the next node",
              from(&Minimum::answers, is_motion_in_words)},
             {"replay_confirmed", "",
              "yes if the replay of a solution over the whole horizon ends near the final state",
              [](const Minimum& minimum) {
                return yes_or_no(has_at_most(minimum.answers, "replay_error", confirmed_replay));
              }}} +
         column_group<Minimum>(methods, "", "number of starts from which this method reached this minimum", found_by);
}

/// A start, and the minimum that it ended in, if it ended in one.
struct StartInPlane {
  Row head;
  std::optional<std::size_t> number = std::nullopt;
  std::optional<Selection> minimum = std::nullopt;
};

Columns<StartInPlane> basin_columns() {
  return head_columns<StartInPlane>(
             {"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals", "bulge_1", "bulge_2"},
             in_key) +
         head_columns<StartInPlane>({"status"}) +
         Columns<StartInPlane>{
             {"minimum", "", "number of the minimum, from the lowest cost upwards", &StartInPlane::number},
             {"objective", "cost", "lowest cost of all solutions at this minimum",
              from(&StartInPlane::minimum, &Selection::front,
                   [](const Row& lowest) { return lowest.number("objective"); })},
             {"is_motion", "", "yes if the intervals of a solution, integrated one by one, reach the next node",
              from(&StartInPlane::minimum, is_motion_in_words)}};
}

/// The outcomes of the starts of a method.
struct StartsOfMethod {
  Row head;
  std::size_t solved = 0;
  std::size_t unconfirmed = 0;
  ShareCount best;

  [[nodiscard]] ShareInterval interval() const { return wilson_interval(best); }
};

Columns<StartsOfMethod> best_share_columns() {
  using Starts = StartsOfMethod;
  return head_columns<Starts>({"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals"},
                              in_key) +
         Columns<Starts>{
             {"starts", "", "number of starts", from(&Starts::best, &ShareCount::trials)},
             {"solved", "", "number of solved starts", &Starts::solved},
             {"unsolved", "", "number of unsolved starts",
              [](const Starts& starts) { return starts.best.trials - starts.solved; }},
             {"unconfirmed", "", "number of starts that ended in a minimum of a grid that is too coarse",
              &Starts::unconfirmed},
             {"best", "", "number of starts that ended in the best minimum", from(&Starts::best, &ShareCount::hits)},
             {"share", "", "share of starts in the best minimum", from(&Starts::best, &ShareCount::share)},
             {"share_lower", "", "lower limit of Wilson's 95 % confidence interval of the share",
              from(&Starts::interval, &ShareInterval::lower)},
             {"share_upper", "", "upper 95 % limit of the share", from(&Starts::interval, &ShareInterval::upper)}};
}

}  // namespace

Table distinct_minima(const Selection& rows, double separation) {
  std::vector<Minimum> all;
  for (const Selection& group : rows.group_by(group_columns)) {
    const std::vector<Selection> minima = minima_of(group, separation);
    const auto best = best_of(minima, finest_best(rows, group.front(), separation), separation);
    for (auto minimum = minima.begin(); minimum != minima.end(); ++minimum) {
      all.push_back({.head = group.front(),
                     .number = static_cast<std::size_t>(minimum - minima.begin()) + 1,
                     .answers = *minimum,
                     .is_best = minimum == best});
    }
  }
  return table_of(minimum_columns(rows.distinct("method")), all);
}

Table basins(const Selection& rows, double separation) {
  std::vector<StartInPlane> all;
  for (const Selection& group : rows.group_by(group_columns)) {
    const std::vector<Selection> minima = minima_of(group, separation);
    std::vector<StartInPlane> starts;
    for (std::size_t i = 0; i < minima.size(); ++i) {
      for (const Row& answer : minima[i]) starts.push_back({.head = answer, .number = i + 1, .minimum = minima[i]});
    }
    for (const Row& answer : group) {
      if (!has_solved_status(answer)) starts.push_back({.head = answer});
    }
    // Line by line of the plane, as an image is drawn.
    std::ranges::stable_sort(starts, {}, [](const StartInPlane& start) {
      return std::tuple(start.head.text("method"), start.head.needed("bulge_2"), start.head.needed("bulge_1"));
    });
    std::ranges::move(starts, std::back_inserter(all));
  }
  return table_of(basin_columns(), all);
}

Table best_minimum_shares(const Selection& rows, double separation) {
  std::vector<StartsOfMethod> all;
  const std::vector<std::string> methods = rows.distinct("method");
  for (const Selection& group : rows.group_by(group_columns)) {
    const std::vector<Selection> minima = minima_of(group, separation);
    const auto best = best_of(minima, finest_best(rows, group.front(), separation), separation);
    for (const std::string& method : methods) {
      const Selection starts = group.where("method", method);
      if (starts.empty()) continue;
      const std::size_t hits = best == minima.end() ? 0 : best->where("method", method).size();
      all.push_back({.head = starts.front(),
                     .solved = starts.where(has_solved_status).size(),
                     .unconfirmed = unconfirmed_of(minima, method),
                     .best = {.hits = hits, .trials = starts.size()}});
    }
  }
  return table_of(best_share_columns(), all);
}

}  // namespace dmocbench
