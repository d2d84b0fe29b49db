#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/model.hpp"
#include "bench/report/words.hpp"
#include "bench/tables/selection.hpp"

namespace dmocbench {

namespace {

/// Counts that differ by less than this factor do not decide between methods.
constexpr double equal_counts = 1.05;

double variables_of(const Row& row) { return row.needed("variables"); }

/// The rows of all methods at the smallest error of a quantity that all of them reach, by the number of variables.
Selection at_smallest_error(const Selection& costs, const std::string& quantity) {
  const Selection of_quantity = costs.where("quantity", quantity).with_number("variables");
  if (of_quantity.empty()) return {};
  const double smallest = of_quantity.min("error");
  return of_quantity.where([&](const Row& row) { return row.needed("error") == smallest; }).sorted_by("variables");
}

/// Whether the first of these rows needs clearly fewer variables than every other.
bool is_decided(const Selection& rows) {
  return rows.size() > 1 && variables_of(*(rows.begin() + 1)) >= equal_counts * variables_of(rows.front());
}

/// "dmoc needs 129 free variables, tangent 258 (2.00 times as many)".
std::string counts_in_words(const Selection& rows) {
  std::vector<std::string> counts;
  for (const Row& row : rows) {
    const std::string& method = row.text("method");
    counts.push_back(counts.empty() ? fmt::format("{} needs {:.0f} free variables", method, variables_of(row))
                                    : fmt::format("{} {:.0f} ({:.2f} times as many)", method, variables_of(row),
                                                  variables_of(row) / variables_of(rows.front())));
  }
  return fmt::format("{}", fmt::join(counts, ", "));
}

/// " With tangent, 3 of 5 grids have a usable solution.", for every method that lacks one.
std::string lacking_in_words(const Selection& solves) {
  std::string words;
  for (const Selection& method : solves.group_by({"method"})) {
    if (!method.are_usable())
      words += fmt::format(" With {}, {} of {} grids have a usable solution.", method.front().text("method"),
                           method.usable().size(), method.size());
  }
  return words;
}

/// The sentences about one problem, tableau and solver.
std::string recommended(const Selection& costs, const Selection& solves) {
  const std::string problem = in_words(costs.front().text("problem"));
  const Selection state = at_smallest_error(costs, "state");
  const Selection replay = at_smallest_error(costs, "replay");
  std::string words;
  if (state.size() == 1) {
    words = fmt::format("Only one method was run for {}.", problem);
  } else if (state.empty()) {
    words = fmt::format("No method is recommended for {}: no state error is reached by all methods.", problem);
  } else if (!is_decided(state)) {
    words = fmt::format("No method is ahead for {}: at a state error of {:.1e}, {}.", problem,
                        state.front().needed("error"), counts_in_words(state));
  } else {
    words = fmt::format("Use {} for {}: at a state error of {:.1e}, {}.", state.front().text("method"), problem,
                        state.front().needed("error"), counts_in_words(state));
  }
  if (!state.empty() && is_decided(replay) && replay.front().text("method") != state.front().text("method"))
    words += fmt::format(" If the controls drive the real system, compare replay errors: at {:.1e}, {}.",
                         replay.front().needed("error"), counts_in_words(replay));
  return words + lacking_in_words(solves);
}

}  // namespace

PageModel recommendations_model(const ResultsFolder& results) {
  PageModel model = PageModel::array();
  const auto named = [&results](const std::string& file) {
    return std::ranges::find(results.tables, file, &ReportedTable::file);
  };
  for (const ReportedTable& costs : results.tables) {
    if (costs.file != costs.run + "_equal_accuracy.csv") continue;
    const auto solves = named(costs.run + ".csv");
    if (solves == results.tables.end() || !has_columns(costs.table, {"quantity", "error", "method", "variables"}) ||
        !has_columns(solves->table, {"method", "status"}))
      continue;
    const ColumnNames scheme{"problem", "tableau", "stages", "solver", "derivatives"};
    for (const Selection& group : Selection(costs.table).group_by(scheme)) {
      model.push_back({{"table", costs.file},
                       {"text", recommended(group, Selection(solves->table).matching(group.front(), scheme))}});
    }
  }
  return model;
}

}  // namespace dmocbench
