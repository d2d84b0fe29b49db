#include "bench/report/measured_answers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/html.hpp"
#include "bench/report/table_markup.hpp"
#include "methods/runtime/counted.hpp"

namespace dmocbench {

namespace {

/// Problem, method, tableau and stages, by which lines are ordered.
using Scheme = std::array<std::string, 4>;

/// The content of a line.
struct Measured {
  std::map<std::string, std::vector<std::string>> orders;  ///< in words, by the table that has them
  std::size_t rows = 0;
  std::size_t solved = 0;
  double finest = 0.0;                        ///< number of intervals of the finest grid that was solved
  std::optional<double> cost = std::nullopt;  ///< on it
};

Scheme scheme_of(const Row& row) {
  return {row.text("problem"), row.text("method"), row.text("tableau"), row.text("stages")};
}

bool has_columns(const Table& table, std::initializer_list<std::string_view> names) {
  return std::ranges::all_of(names,
                             [&](std::string_view name) { return std::ranges::count(table.columns(), name) > 0; });
}

/// Whether a table has one fit per scheme and quantity: tables about more, such as situations, have more
/// columns.
bool has_fits(const Table& table) {
  constexpr std::array<std::string_view, 16> known{
      "problem", "library",  "settings",   "method",   "tableau",        "stages", "quantity", "slope",
      "finest",  "coarsest", "coarse_end", "fine_end", "standard_error", "points", "floor",    "verdict"};
  return has_columns(table, {"problem", "method", "quantity", "slope", "standard_error"}) &&
         std::ranges::all_of(table.columns(),
                             [&](const std::string& column) { return std::ranges::count(known, column) > 0; });
}

/// "state 2.01 ± 0.02", "state 2.01" where two grids give no error, "costate: floor" without a fit.
std::string order_in_words(const Row& row) {
  const std::string quantity = in_words(row.text("quantity"));
  const auto slope = row.number("slope");
  const auto error = row.number("standard_error");
  if (!slope) return fmt::format("{}: {}", quantity, row.text("verdict").empty() ? "no order" : row.text("verdict"));
  return error ? fmt::format("{} {:.3f} ± {:.2g}", quantity, *slope, *error)
               : fmt::format("{} {:.3f}", quantity, *slope);
}

std::map<Scheme, Measured> measured_by_scheme(const ResultsFolder& results) {
  std::map<Scheme, Measured> all;
  for (const ReportedTable& reported : results.tables) {
    const bool has_orders = has_fits(reported.table);
    const bool has_solves =
        reported.file == reported.run + ".csv" && has_columns(reported.table, {"problem", "method", "status"});
    for (const Row& row : reported.table.rows()) {
      if (has_orders) all[scheme_of(row)].orders[reported.file].push_back(order_in_words(row));
      if (!has_solves) continue;
      Measured& measured = all[scheme_of(row)];
      ++measured.rows;
      if (is_unsolved(row)) continue;
      ++measured.solved;
      const double intervals = row.number("intervals", 0.0);
      if (!row.number("objective") || intervals < measured.finest) continue;
      measured.finest = intervals;
      measured.cost = row.number("objective");
    }
  }
  return all;
}

std::string line_html(const Scheme& scheme, const Measured& measured) {
  const auto& [problem, method, tableau, stages] = scheme;
  std::vector<std::string> parts;
  parts.reserve(measured.orders.size() + 2);
  if (measured.cost) parts.push_back(fmt::format("cost {:.9g} with N = {:g}", *measured.cost, measured.finest));
  for (const auto& [file, orders] : measured.orders) {
    parts.push_back(fmt::format("<a href=\"#{}\">fitted orders</a> {}", anchor("table", file),
                                escaped_prose(fmt::format("{}", fmt::join(orders, ", ")))));
  }
  if (measured.rows > 0)
    parts.push_back(fmt::format("{} of {} solved", measured.solved, counted(measured.rows, "solve")));
  const std::string steps =
      stages.empty() ? tableau
                     : fmt::format("{}, {} per step", tableau, stages == "1" ? "1 stage" : stages + " stages");
  return fmt::format("<li><b>{} by {}</b>{}: {}.</li>\n", escaped(in_words(problem)), escaped(method_in_words(method)),
                     steps.empty() ? "" : escaped(fmt::format(" ({})", steps)), fmt::join(parts, "; "));
}

}  // namespace

std::string measured_answers_html(const ResultsFolder& results) {
  std::string lines;
  for (const auto& [scheme, measured] : measured_by_scheme(results)) lines += line_html(scheme, measured);
  return lines.empty() ? "" : "<ul class=\"answers\">\n" + lines + "</ul>\n";
}

}  // namespace dmocbench
