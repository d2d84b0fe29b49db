#include "bench/tables/advantage_ratios.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "bench/tables/ratio_interval.hpp"
#include "bench/tables/ratios.hpp"

namespace dmocbench {

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
                            "quantity", "the quantity that is compared"),
      costs);
}

}  // namespace dmocbench
