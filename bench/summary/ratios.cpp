#include "bench/summary/ratios.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bench/summary/column_meanings.hpp"
#include "bench/summary/ratio_interval.hpp"

namespace dmocbench {

namespace {

struct Currency {
  const char* name;
  const char* solver;
  const char* crash;
  const char* column;
};

constexpr std::array currencies{
    Currency{"free_variables", "sqp", "none", "free_variables"},
    Currency{"kkt_nonzeros", "sqp", "none", "kkt_nonzeros"},
    Currency{"factor_nonzeros", "sqp", "none", "factor_nonzeros"},
    Currency{"minor_iterations", "sqp", "none", "minor_iterations"},
    Currency{"minor_iterations_crash_basis", "sqp", "basis", "minor_iterations"},
    Currency{"sqp_major_iterations", "sqp", "none", "major_iterations"},
    Currency{"sqp_seconds", "sqp", "none", "seconds"},
    Currency{"sqp_seconds_crash_basis", "sqp", "basis", "seconds"},
    Currency{"ipopt_iterations", "ipopt", "", "major_iterations"},
    Currency{"ipopt_seconds", "ipopt", "", "seconds"},
    Currency{"slsqp_evaluations", "nlopt", "", "evaluations"},
    Currency{"slsqp_seconds", "nlopt", "", "seconds"},
};

constexpr double steps_per_decade = 2.0;

/// What a method pays for an accuracy: the column in the table of equal accuracy, and the column of a solve that it is
/// read from.
constexpr std::array costs{std::pair{"intervals", "intervals"}, std::pair{"variables", "free_variables"},
                           std::pair{"seconds", "seconds"}};

/// A row for every method if all of them reach the error.
void append_equal_accuracy(Table& table, const std::vector<Selection>& methods, const std::string& quantity,
                           double error) {
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
    for (const std::string cost : {"variables", "seconds"}) {
      row.set(cost + "_ratio", ratio(row.number(cost), dmoc.number(cost)));
    }
    table.append(std::move(row));
  }
}

}  // namespace

Cost cost_in(const std::string& column) {
  return [column](const Row& row) { return row.number(column); };
}

std::vector<ErrorCostPoint> error_cost_points(const Selection& rows, const std::string& error_column,
                                              const Cost& cost) {
  std::vector<ErrorCostPoint> points;
  for (const Row& row : rows.usable()) {
    const double error = row.number(error_column, 0.0);
    const double cost_of_row = cost(row).value_or(0.0);
    if (error > 0.0 && std::isfinite(error) && cost_of_row > 0.0) points.push_back({std::log10(error), cost_of_row});
  }
  return points;
}

std::optional<double> cost_at_error(const std::vector<ErrorCostPoint>& points, double error, double same_log_error) {
  const double wanted = std::log10(error);
  for (const ErrorCostPoint& point : points) {
    if (std::abs(point.log_error - wanted) < same_log_error) return point.cost;
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const ErrorCostPoint& a = points[i];
    const ErrorCostPoint& b = points[i + 1];
    if (wanted > a.log_error || wanted < b.log_error || a.log_error == b.log_error) continue;
    const double weight = (wanted - a.log_error) / (b.log_error - a.log_error);
    return std::pow(10.0, std::log10(a.cost) + weight * (std::log10(b.cost) - std::log10(a.cost)));
  }
  return std::nullopt;
}

void set_cost_ratios(Row& result, const Row& row, const Selection& others, const Cost& cost,
                     const std::string& error_column, double same_log_error) {
  const Row& on_same_grid = others.matching(row, {"intervals"}).front();
  result.set("ratio_at_equal_intervals", ratio(cost(row), cost(on_same_grid)));
  const double error = row.number(error_column, 0.0);
  if (!(error > 0.0)) return;
  const auto at_same_error = cost_at_error(error_cost_points(others, error_column, cost), error, same_log_error);
  result.set("ratio_at_equal_accuracy", ratio(cost(row), at_same_error));
}

Table equal_accuracy(const Selection& convergence) {
  Table table({"problem", "tableau", "stages", "quantity", "error", "method", "intervals", "variables", "seconds",
               "variables_ratio", "seconds_ratio"});
  explain(table, meanings_in_ratios());
  for (const Selection& compared : convergence.group_by({"problem", "tableau", "stages", "solver"})) {
    for (const std::string quantity : {"state", "control", "replay"}) {
      const auto points = error_cost_points(compared, quantity + "_error", cost_in("seconds"));
      if (points.empty()) continue;
      const auto [smallest, largest] = std::ranges::minmax(points, {}, &ErrorCostPoint::log_error);
      for (double k = std::floor(largest.log_error * steps_per_decade);
           k >= std::ceil(smallest.log_error * steps_per_decade); --k) {
        append_equal_accuracy(table, compared.group_by({"method", "derivatives"}), quantity,
                              std::pow(10.0, k / steps_per_decade));
      }
    }
  }
  return table;
}

Table currency_ratios(const Selection& iterations) {
  Table table({"problem", "method", "tableau", "stages", "intervals", "currency", "ratio_at_equal_intervals",
               "ratio_at_equal_accuracy", "ratio_lower", "ratio_upper", "round_ratios"});
  explain(table, meanings_in_ratios());
  for (const Selection& compared : iterations.group_by({"problem", "tableau", "stages", "solver"})) {
    const Selection dmoc = compared.where("method", "dmoc").usable();
    for (const Selection& collocation : compared.group_by({"method", "derivatives"})) {
      if (collocation.front().text("method") == "dmoc" || compared.where("method", "dmoc").empty()) continue;
      for (const Currency& currency : currencies) {
        if (collocation.front().text("solver") != currency.solver) continue;
        for (const Row& row : collocation.usable().where("crash", currency.crash)) {
          Row result = fields_of(row, {"problem", "method", "tableau", "stages", "intervals"});
          result.set("currency", currency.name);
          const Selection others = dmoc.where("crash", currency.crash);
          set_cost_ratios(result, row, others, cost_in(currency.column), "replay_error");
          if (currency.column == std::string_view("seconds")) {
            const Row& on_same_grid = others.matching(row, {"intervals"}).front();
            set_rounds(result, round_ratios(row.numbers("round_seconds"), on_same_grid.numbers("round_seconds")));
          }
          table.append(std::move(result));
        }
      }
    }
  }
  return table;
}

}  // namespace dmocbench
