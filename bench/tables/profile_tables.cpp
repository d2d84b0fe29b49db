#include "bench/tables/profile_tables.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "bench/run/column.hpp"
#include "bench/run/solve_case.hpp"
#include "methods/numerics/quantile.hpp"

namespace dmocbench {

namespace {

constexpr double smallest_effort = 1e-9;  // smaller efforts count as equal
constexpr double never = std::numeric_limits<double>::infinity();

const ColumnNames competitor_columns{"method", "tableau", "stages", "solver", "derivatives"};

/// Every competitor's effort on every instance, by one measure; `never` where it failed or has no row or no value.
struct Contest {
  std::vector<Row> competitors;            // their names, in the order of the rows
  std::vector<std::vector<double>> taken;  // instance, competitor
};

Contest contest_of(const Selection& rows, const std::string& measure) {
  Contest contest;
  for (const Selection& competitor : rows.group_by(competitor_columns)) {
    contest.competitors.push_back(fields_of(competitor.front(), competitor_columns));
  }
  for (const Selection& instance : rows.group_by({"problem", "intervals"})) {
    std::vector<double>& taken = contest.taken.emplace_back();
    for (const Row& competitor : contest.competitors) {
      const Row& solve = instance.matching(competitor, competitor_columns).back();
      taken.push_back(solve.text("success") == "yes" ? solve.number(measure, never) : never);
    }
  }
  return contest;
}

/// x / y where both may be 0, as counts can.
double effort_ratio(double x, double y) { return x == y ? 1.0 : x / std::max(y, smallest_effort); }

/// A step of a competitor's profile.
struct ProfilePoint {
  Row head;
  std::string measure;
  double ratio = 1.0;
  double share = 0.0;
};

Columns<ProfilePoint> point_columns() {
  using Point = ProfilePoint;
  return Columns<Point>{{"measure", "", "measure of the profile", &Point::measure}} +
         head_columns<Point>(competitor_columns) +
         Columns<Point>{
             {"ratio", "", "effort of a competitor divided by the best competitor's effort on the same instance",
              &Point::ratio},
             {"share", "", "share of all instances on which the competitor stays within the ratio", &Point::share}};
}

/// A competitor's effort by one measure.
struct MeanEffort {
  std::optional<double> mean;  ///< infinite where the solver does not report the measure
  std::ptrdiff_t wins = 0;
};

struct Standing {
  Row head;
  std::size_t instances = 0;
  std::ptrdiff_t successes = 0;
  std::size_t common = 0;
  std::map<std::string, MeanEffort> efforts = {};  ///< by measures
};

Columns<Standing> standing_columns() {
  Columns<Standing> columns =
      head_columns<Standing>(competitor_columns, in_key) +
      Columns<Standing>{{"instances", "", "number of instances: problems on each grid", &Standing::instances},
                        {"successes", "", "number of instances solved to the reference", &Standing::successes},
                        {"common", "", "number of instances on which all competitors succeed", &Standing::common}};
  for (const std::string& measure : profile_measures()) {
    const auto effort = [measure](const Standing& standing) { return standing.efforts.at(measure); };
    const bool is_time = measure == "seconds";
    columns.push_back({measure, is_time ? "s" : "", "shifted geometric mean over the common instances",
                       from(effort, &MeanEffort::mean)});
    columns.push_back({"wins_" + measure, "",
                       is_time ? "number of instances on which no competitor is faster"
                               : "number of instances on which no competitor takes fewer",
                       from(effort, &MeanEffort::wins)});
  }
  return columns;
}

/// Sets means over the common instances, and wins, by one measure.
void set_measure(const Contest& contest, const std::string& measure, const std::vector<std::size_t>& common,
                 std::vector<Standing>& standings) {
  std::vector<double> told;
  for (const std::size_t i : common) {
    std::ranges::copy_if(contest.taken[i], std::back_inserter(told), [](double taken) { return taken < never; });
  }
  const double shift = median(told);
  for (std::size_t who = 0; who < standings.size(); ++who) {
    double sum = 0.0;
    for (const std::size_t i : common) sum += std::log(contest.taken[i][who] + shift);
    standings[who].efforts[measure] = {
        .mean = std::exp(sum / static_cast<double>(common.size())) - shift,
        .wins = std::ranges::count_if(contest.taken, [&](const std::vector<double>& taken) {
          return taken[who] < never && taken[who] == std::ranges::min(taken);
        })};
  }
}

/// A solve of the table of the library.
struct LibraryAnswer {
  Row head;
  [[nodiscard]] std::optional<double> relative_difference() const {
    const auto reference = head.number("reference_objective");
    const auto objective = head.number("objective");
    if (!reference || !objective) return std::nullopt;
    return (*objective - *reference) / std::abs(*reference);
  }
};

Columns<LibraryAnswer> library_columns() {
  using Answer = LibraryAnswer;
  return head_columns<Answer>({"problem", "reference_objective"}) +
         Columns<Answer>{{"reference_digits", "", "valid digits of the reference",
                          [](const Answer& answer) { return answer.head.number("reference_digits"); }}} +
         head_columns<Answer>({"reference_kind", "method", "tableau", "stages", "solver", "derivatives", "intervals",
                               "status", "objective"}) +
         Columns<Answer>{{"relative_difference", "", "signed difference of the objective from the reference",
                          &Answer::relative_difference}} +
         head_columns<Answer>({"success", "replay_error", "message"});
}

/// "0.5545708783346 (13 digits)".
std::string reference_in_words(const Row& row) {
  const auto reference = row.number("reference_objective");
  const auto digits = row.number("reference_digits");
  if (reference && row.text("reference_kind") == best_found_reference) {
    return fmt::format("{:.7g} ({})", *reference, best_found_reference);
  }
  if (!reference || !digits) return "unknown";
  return fmt::format("{:.{}g} ({} digits)", *reference, static_cast<int>(*digits), *digits);
}

/// "0.554575 (+7.4e-06)", or the status; "elsewhere" marks a solve without success.
std::string answer_in_words(const Row& row) {
  if (!has_solved_status(row)) return row.text("status");
  std::string words = fmt::format("{:.7g}", row.number("objective", std::nan("")));
  if (const auto difference = row.number("relative_difference")) words += fmt::format(" ({:+.1e})", *difference);
  return row.text("success") == "no" ? words + " elsewhere" : words;
}

}  // namespace

const std::vector<std::string>& profile_measures() {
  static const std::vector<std::string> measures{"seconds", "evaluations", "major_iterations"};
  return measures;
}

Table performance_profiles(const Selection& rows) {
  std::vector<ProfilePoint> profile;
  for (const std::string& measure : profile_measures()) {
    const Contest contest = contest_of(rows, measure);
    std::vector<std::vector<double>> ratios(contest.competitors.size());
    double largest = 1.0;
    for (const std::vector<double>& taken : contest.taken) {
      for (std::size_t who = 0; who < ratios.size(); ++who) {
        if (taken[who] == never) continue;
        ratios[who].push_back(effort_ratio(taken[who], std::ranges::min(taken)));
        largest = std::max(largest, ratios[who].back());
      }
    }
    for (std::size_t who = 0; who < ratios.size(); ++who) {
      std::vector<double>& steps = ratios[who];
      std::ranges::sort(steps);
      std::vector<double> points{1.0};
      std::ranges::copy_if(steps, std::back_inserter(points), [](double step) { return step > 1.0; });
      points.push_back(largest);
      for (const double point : points) {
        const auto within = static_cast<double>(std::ranges::upper_bound(steps, point) - steps.begin());
        profile.push_back(
            {contest.competitors[who], measure, point, within / static_cast<double>(contest.taken.size())});
      }
    }
  }
  return table_of(point_columns(), profile);
}

Table profile_summary(const Selection& rows) {
  // Successes do not depend on the measure; every solved row has an objective.
  const Contest successes = contest_of(rows, "objective");
  std::vector<std::size_t> common;
  for (std::size_t i = 0; i < successes.taken.size(); ++i) {
    if (std::ranges::max(successes.taken[i]) < never) common.push_back(i);
  }
  std::vector<Standing> standings;
  for (std::size_t who = 0; who < successes.competitors.size(); ++who) {
    const auto has_solved = [who](const std::vector<double>& taken) { return taken[who] < never; };
    standings.push_back({.head = successes.competitors[who],
                         .instances = successes.taken.size(),
                         .successes = std::ranges::count_if(successes.taken, has_solved),
                         .common = common.size()});
  }
  for (const std::string& measure : profile_measures())
    set_measure(contest_of(rows, measure), measure, common, standings);
  return table_of(standing_columns(), standings);
}

Table with_best_found_references(const Table& rows, double tolerance) {
  std::map<std::string, double> best;
  for (const Selection& problem : Selection(rows).group_by({"problem"})) {
    const Selection solved = problem.where(has_solved_status).with_number("objective").sorted_by("intervals");
    if (solved.empty() || problem.front().number("reference_objective")) continue;
    best[problem.front().text("problem")] = solved.where("intervals", solved.back().text("intervals")).min("objective");
  }
  Table result(rows.columns());
  for (Row row : rows.rows()) {
    const auto found = best.find(row.text("problem"));
    if (found != best.end()) {
      row.set("reference_objective", found->second);
      row.set("reference_kind", best_found_reference);
      const auto objective = has_solved_status(row) ? row.number("objective") : std::nullopt;
      const double error = std::abs(objective.value_or(never) - found->second);
      if (objective) row.set("objective_error", error);
      row.set("success", error <= tolerance * std::abs(found->second) ? "yes" : "no");
    }
    result.append(std::move(row));
  }
  return result;
}

Table library_table(const Selection& rows) {
  std::vector<LibraryAnswer> answers;
  for (const Selection& curve : rows.group_by({"problem", "method", "tableau", "stages", "solver", "derivatives"})) {
    const std::string& finest = curve.sorted_by("intervals").back().text("intervals");
    for (const Row& row : curve.where("intervals", finest)) answers.push_back({row});
  }
  return table_of(library_columns(), answers);
}

std::string library_table_in_markdown(const Selection& library) {
  const std::vector<std::string> methods = library.distinct("method");
  std::string text =
      "# The library\n\nEvery problem is solved from its own guess. An entry is the cost that a method reaches and, in "
      "brackets, its relative difference from the reference, or the status of a failed solve. \"Elsewhere\" means that "
      "the cost is too far from the reference to count as a success: another minimum, or a grid that is too coarse.\n";
  for (const Selection& scheme : library.group_by({"tableau", "stages", "solver", "derivatives"})) {
    const Row& head = scheme.front();
    text += fmt::format("\n## {} {}, {}, {}\n\n| problem | N | reference | {} |\n|---|---|---|", head.text("tableau"),
                        head.text("stages"), head.text("solver"), head.text("derivatives"), fmt::join(methods, " | "));
    for (std::size_t i = 0; i < methods.size(); ++i) text += "---|";
    const std::vector<Selection> problems = scheme.group_by({"problem"});
    for (const Selection& answers : problems) {
      text += fmt::format("\n| {} | {} | {} |", answers.front().text("problem"), answers.front().text("intervals"),
                          reference_in_words(answers.front()));
      for (const std::string& method : methods) {
        text += " " + answer_in_words(answers.where("method", method).front()) + " |";
      }
    }
    const auto count_by_all = [&](const char* column, const char* said) {
      return std::ranges::count_if(problems, [&](const Selection& answers) {
        return std::ranges::all_of(methods, [&](const std::string& method) {
          return answers.where("method", method).front().text(column) == said;
        });
      });
    };
    text += fmt::format("\n\nSolved with all methods: {} of {} problems; successful with all methods: {}.\n",
                        count_by_all("status", "solved"), problems.size(), count_by_all("success", "yes"));
  }
  return text;
}

}  // namespace dmocbench
