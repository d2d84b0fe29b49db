#include "bench/tables/ratios.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

/// The cost of an accuracy by a method.
struct AccuracyCost {
  Row head;
  std::string quantity;
  double error = 0.0;
  std::optional<double> intervals = std::nullopt;
  std::optional<double> variables = std::nullopt;
  std::optional<double> seconds = std::nullopt;
  std::optional<double> variables_ratio = std::nullopt;
  std::optional<double> seconds_ratio = std::nullopt;
};

Columns<AccuracyCost> accuracy_cost_columns() {
  using Paid = AccuracyCost;
  return head_columns<Paid>({"problem", "tableau", "stages", "solver", "derivatives"}, in_key) +
         Columns<Paid>{{"quantity", "", "quantity that is compared", &Paid::quantity, in_key},
                       {"error", "", "error that all methods with this tableau, solver and derivatives reach",
                        &Paid::error, in_key}} +
         head_columns<Paid>({"method"}, in_key) +
         Columns<Paid>{{"intervals", "", "number of intervals N, interpolated between grids", &Paid::intervals},
                       {"variables", "", "number of free variables", &Paid::variables},
                       {"seconds", "s", "time of a solve", &Paid::seconds},
                       {"variables_ratio", "", "variables relative to dmoc at this error", &Paid::variables_ratio},
                       {"seconds_ratio", "", "seconds relative to dmoc at this error", &Paid::seconds_ratio}};
}

/// The cost of every method if all of them reach the error.
void append_equal_accuracy(std::vector<AccuracyCost>& table, const std::vector<Selection>& methods,
                           const std::string& quantity, double error) {
  std::vector<AccuracyCost> all;
  for (const Selection& method : methods) {
    const auto paid = [&](const char* column) {
      return cost_at_error(error_cost_points(method, quantity + "_error", cost_in(column)), error);
    };
    all.push_back({.head = method.front(),
                   .quantity = quantity,
                   .error = error,
                   .intervals = paid("intervals"),
                   .variables = paid("free_variables"),
                   .seconds = paid("seconds")});
    if (!all.back().intervals || !all.back().variables || !all.back().seconds) return;
  }
  const auto dmoc = std::ranges::find(all, "dmoc", [](const AccuracyCost& cost) { return cost.head.text("method"); });
  for (AccuracyCost cost : all) {
    if (dmoc != all.end()) {
      cost.variables_ratio = ratio(cost.variables, dmoc->variables);
      cost.seconds_ratio = ratio(cost.seconds, dmoc->seconds);
    }
    table.push_back(std::move(cost));
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

CostRatios cost_ratios(const Row& row, const Selection& others, const Cost& cost, const std::string& error_column,
                       double same_log_error) {
  CostRatios ratios{.at_equal_intervals = ratio(cost(row), cost(others.matching(row, {"intervals"}).front()))};
  const double error = row.number(error_column, 0.0);
  if (error > 0.0) {
    const auto points = error_cost_points(others, error_column, cost);
    ratios.at_equal_accuracy = ratio(cost(row), cost_at_error(points, error, same_log_error));
  }
  return ratios;
}

Columns<ComparedCost> compared_cost_columns(const ColumnNames& of_head, const std::string& name,
                                            const std::string& meaning) {
  return head_columns<ComparedCost>(of_head, in_key) +
         Columns<ComparedCost>{
             {name, "", meaning, &ComparedCost::name, in_key},
             {"ratio_at_equal_intervals", "", "ratio of the method to dmoc on the same number of intervals",
              from(&ComparedCost::ratios, &CostRatios::at_equal_intervals)},
             {"ratio_at_equal_accuracy", "", "ratio of the method to dmoc at equal errors",
              from(&ComparedCost::ratios, &CostRatios::at_equal_accuracy)}} +
         round_columns<ComparedCost>(&ComparedCost::rounds);
}

Table equal_accuracy(const Selection& convergence) {
  std::vector<AccuracyCost> table;
  for (const Selection& compared : convergence.group_by({"problem", "tableau", "stages", "solver", "derivatives"})) {
    for (const std::string quantity : {"state", "control", "replay"}) {
      const auto points = error_cost_points(compared, quantity + "_error", cost_in("seconds"));
      if (points.empty()) continue;
      const auto [smallest, largest] = std::ranges::minmax(points, {}, &ErrorCostPoint::log_error);
      for (double k = std::floor(largest.log_error * steps_per_decade);
           k >= std::ceil(smallest.log_error * steps_per_decade); --k) {
        append_equal_accuracy(table, compared.group_by({"method"}), quantity, std::pow(10.0, k / steps_per_decade));
      }
    }
  }
  return table_of(accuracy_cost_columns(), table);
}

Table currency_ratios(const Selection& iterations) {
  std::vector<ComparedCost> costs;
  for (const Selection& compared :
       iterations.group_by({"problem", "tableau", "stages", "solver", "derivatives", "tolerance"})) {
    const Selection dmoc = compared.where("method", "dmoc").usable();
    for (const Selection& collocation : compared.group_by({"method"})) {
      if (collocation.front().text("method") == "dmoc" || compared.where("method", "dmoc").empty()) continue;
      for (const Currency& currency : currencies) {
        if (collocation.front().text("solver") != currency.solver) continue;
        const Selection others = dmoc.where("crash", currency.crash);
        for (const Row& row : collocation.usable().where("crash", currency.crash)) {
          ComparedCost& cost = costs.emplace_back(
              ComparedCost{.head = row,
                           .name = currency.name,
                           .ratios = cost_ratios(row, others, cost_in(currency.column), "replay_error")});
          if (currency.column == std::string_view("seconds")) {
            const Row& on_same_grid = others.matching(row, {"intervals"}).front();
            cost.rounds =
                MedianOfRounds(round_ratios(row.numbers("round_seconds"), on_same_grid.numbers("round_seconds")));
          }
        }
      }
    }
  }
  return table_of(
      compared_cost_columns({"problem", "method", "tableau", "stages", "derivatives", "tolerance", "intervals"},
                            "currency", "measure of the cost of a solve"),
      costs);
}

namespace {

constexpr double same_objective = 1e-6;
/// Errors of the objective that are equal up to rounding, as logarithms.
constexpr double same_error = 1e-4;

struct ComparedQuantity {
  const char* name = "";
  const char* column = "";
  const char* rounds = "";  ///< column with the times of the rounds, and
  const char* parts = "";   ///< column of their divisor; may be empty

  /// The ratios to another row, one per round; empty if the quantity is not a time.
  [[nodiscard]] std::vector<double> ratios(const Row& row, const Row& other) const {
    std::vector<double> ratios = round_ratios(row.numbers(rounds), other.numbers(rounds));
    const double divisor = std::string_view(parts).empty() ? 1.0 : row.needed(parts) / other.needed(parts);
    for (double& ratio : ratios) ratio /= divisor;
    return ratios;
  }
};

constexpr std::array quantities{
    ComparedQuantity{"seconds", "seconds", "round_seconds"},
    ComparedQuantity{"seconds_per_iteration", "seconds_per_iteration", "round_seconds", "major_iterations"},
    ComparedQuantity{"linear_algebra_per_iteration", "linear_algebra_per_iteration"},
    ComparedQuantity{"seconds_per_linear_system", "seconds_per_linear_system", "round_linear_seconds",
                     "linear_systems"},
    ComparedQuantity{"iterations", "major_iterations"},
};

const ColumnNames program_columns{"problem", "method", "tableau", "stages", "intervals"};
const ColumnNames line_columns{"problem", "method", "tableau", "stages", "solver", "factorisation"};

/// The rows that count.
Selection comparable_rows(const Selection& table) {
  const Selection rows = table.usable().with_number("objective");
  return rows.where([&](const Row& row) {
    const double lowest = rows.matching(row, program_columns).min("objective");
    return row.number("objective", 0.0) - lowest <= same_objective * std::abs(lowest);
  });
}

}  // namespace

Table advantage_ratios(const Selection& advantage) {
  std::vector<ComparedCost> costs;
  const Selection rows = comparable_rows(advantage);
  for (const Selection& line : rows.group_by(line_columns)) {
    const Selection dmoc = rows.where("method", "dmoc")
                               .matching(line.front(), {"problem", "tableau", "stages", "solver", "factorisation"});
    if (line.front().text("method") == "dmoc" || dmoc.empty()) continue;
    for (const ComparedQuantity& quantity : quantities) {
      const Cost cost = [&](const Row& row) { return row.number(quantity.column); };
      for (const Row& row : line.where([&](const Row& solved) { return cost(solved).has_value(); })) {
        const Row& on_same_grid = dmoc.matching(row, {"intervals"}).front();
        costs.push_back({.head = row,
                         .name = quantity.name,
                         .ratios = cost_ratios(row, dmoc, cost, "objective_error", same_error),
                         .rounds = MedianOfRounds(quantity.ratios(row, on_same_grid))});
      }
    }
  }
  return table_of(
      compared_cost_columns({"problem", "method", "tableau", "stages", "solver", "factorisation", "intervals"},
                            "quantity", "quantity that is compared"),
      costs);
}

}  // namespace dmocbench
