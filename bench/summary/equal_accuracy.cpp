#include "bench/summary/equal_accuracy.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/summary/ratios.hpp"

namespace dmocbench {

namespace {

constexpr double steps_per_decade = 2.0;
constexpr std::array quantities{"state", "control"};
/// Columns of the table, and of the rows that they are read from.
constexpr std::array costs{std::pair{"intervals", "intervals"}, std::pair{"variables", "free_variables"},
                           std::pair{"seconds", "seconds"}};

/// A row for every method if all of them reach the error.
void append_rows(const std::vector<Selection>& methods, const std::string& quantity, double error, Table& table) {
  Table rows;
  for (const Selection& method : methods) {
    Row row = fields_of(method.front(), {"problem", "tableau", "stages", "method"});
    row.set("quantity", quantity);
    row.set("error", error);
    for (const auto& [column, source] : costs) {
      const auto cost = cost_at_error(error_cost_points(method, quantity + "_error", cost_in(source)), error);
      if (!cost) return;
      row.set(column, cost);
    }
    rows.append(std::move(row));
  }
  const Row& dmoc = Selection(rows).where("method", "dmoc").front();
  for (Row row : rows.rows()) {
    row.set("variables_ratio", ratio(row.number("variables"), dmoc.number("variables")));
    row.set("seconds_ratio", ratio(row.number("seconds"), dmoc.number("seconds")));
    table.append(std::move(row));
  }
}

}  // namespace

Table equal_accuracy(const Selection& convergence) {
  Table table({"problem", "tableau", "stages", "quantity", "error", "method", "intervals", "variables", "seconds",
               "variables_ratio", "seconds_ratio"});
  for (const Selection& compared : convergence.group_by({"problem", "tableau", "stages", "solver"})) {
    for (const std::string quantity : quantities) {
      double largest_log_error = -std::numeric_limits<double>::infinity();
      double smallest_log_error = std::numeric_limits<double>::infinity();
      for (const ErrorCostPoint& point : error_cost_points(compared, quantity + "_error", cost_in("seconds"))) {
        largest_log_error = std::max(largest_log_error, point.log_error);
        smallest_log_error = std::min(smallest_log_error, point.log_error);
      }
      if (!std::isfinite(largest_log_error)) continue;
      for (double k = std::floor(largest_log_error * steps_per_decade);
           k >= std::ceil(smallest_log_error * steps_per_decade); --k) {
        append_rows(compared.group_by({"method", "derivatives"}), quantity, std::pow(10.0, k / steps_per_decade),
                    table);
      }
    }
  }
  return table;
}

}  // namespace dmocbench
