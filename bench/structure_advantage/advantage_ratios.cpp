#include "bench/structure_advantage/advantage_ratios.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiment/solve_case.hpp"
#include "bench/summary/cost_at_error.hpp"

namespace dmocbench {

namespace {

constexpr double same_objective = 1e-6;
/// Errors of the objective that are equal but for rounding, as logarithms.
constexpr double same_error = 1e-4;

struct Quantity {
  const char* name = "";
  const char* column = "";
  bool is_per_interval = false;  ///< in the table
};

constexpr std::array quantities{
    Quantity{"seconds", "seconds"},
    Quantity{"seconds_per_iteration", "seconds_per_iteration"},
    Quantity{"linear_algebra_per_iteration", "linear_algebra_per_iteration"},
    Quantity{"seconds_per_linear_system", "seconds_per_linear_system"},
    Quantity{"iterations", "major_iterations"},
    Quantity{"operations", "operations_per_interval", true},
    Quantity{"elimination_operations", "elimination_operations_per_interval", true},
};

std::optional<double> cost_of(const Row& row, const Quantity& quantity) {
  const auto value = row.number(quantity.column);
  if (!value || !quantity.is_per_interval) return value;
  return *value * row.number("intervals").value_or(0.0);
}

using Key = std::vector<std::string>;
/// The rows of one method by one solver and factorisation: its grids.
using Line = std::vector<const Row*>;

Key key_of(const Row& row, const std::vector<const char*>& columns) {
  Key key;
  for (const char* column : columns) key.push_back(row.text(column));
  return key;
}

const std::vector<const char*> program_columns{"problem", "method", "tableau", "stages", "intervals"};
const std::vector<const char*> line_columns{"method", "problem", "tableau", "stages", "solver", "factorisation"};

/// The rows that count.
std::vector<const Row*> comparable_rows(const Table& table) {
  std::map<Key, double> lowest;
  for (const Row& row : table.rows()) {
    if (!is_usable(row)) continue;
    const double objective = row.number("objective").value_or(std::numeric_limits<double>::infinity());
    const auto [found, is_first] = lowest.try_emplace(key_of(row, program_columns), objective);
    if (!is_first) found->second = std::min(found->second, objective);
  }
  std::vector<const Row*> rows;
  for (const Row& row : table.rows()) {
    if (!is_usable(row)) continue;
    const double wanted = lowest.at(key_of(row, program_columns));
    if (row.number("objective").value_or(wanted) - wanted <= same_objective * std::abs(wanted)) rows.push_back(&row);
  }
  return rows;
}

std::optional<double> on_same_grid(const Line& line, const Row& other, const Quantity& quantity) {
  for (const Row* row : line) {
    if (row->text("intervals") == other.text("intervals")) return cost_of(*row, quantity);
  }
  return std::nullopt;
}

std::optional<double> at_same_error(const Line& line, const Row& other, const Quantity& quantity) {
  const auto error = other.number("objective_error");
  if (!error || !(*error > 0.0)) return std::nullopt;
  std::vector<ErrorCostPoint> points;
  for (const Row* row : line) {
    const auto cost = cost_of(*row, quantity);
    const double error_of_row = row->number("objective_error").value_or(0.0);
    if (!cost || !(*cost > 0.0) || !(error_of_row > 0.0)) continue;
    points.push_back({std::log10(error_of_row), std::log10(*cost)});
    if (std::abs(points.back().error - std::log10(*error)) < same_error) return cost;
  }
  return cost_at_error(points, *error);
}

std::optional<double> ratio(std::optional<double> a, std::optional<double> b) {
  if (!a || !b || !(*b > 0.0)) return std::nullopt;
  return *a / *b;
}

}  // namespace

Table advantage_ratios(const Table& advantage) {
  Table table({"problem", "method", "tableau", "stages", "solver", "factorisation", "intervals", "quantity",
               "ratio_at_equal_intervals", "ratio_at_equal_accuracy"});
  const std::vector<const Row*> rows = comparable_rows(advantage);
  std::map<Key, Line> lines;
  for (const Row* row : rows) lines[key_of(*row, line_columns)].push_back(row);
  for (const Row* head : rows) {
    Key key = key_of(*head, line_columns);
    const Line& line = lines.at(key);
    key.front() = "dmoc";
    const auto dmoc = lines.find(key);
    if (head != line.front() || head->text("method") == "dmoc" || dmoc == lines.end()) continue;
    for (const Quantity& quantity : quantities) {
      for (const Row* row : line) {
        const auto cost = cost_of(*row, quantity);
        if (!cost) continue;
        Row result;
        for (const char* column : line_columns) result.set(column, row->text(column));
        result.set("intervals", row->text("intervals"));
        result.set("quantity", quantity.name);
        result.set("ratio_at_equal_intervals", ratio(cost, on_same_grid(dmoc->second, *row, quantity)));
        result.set("ratio_at_equal_accuracy", ratio(cost, at_same_error(dmoc->second, *row, quantity)));
        table.append(std::move(result));
      }
    }
  }
  return table;
}

}  // namespace dmocbench
