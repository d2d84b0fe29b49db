#include "bench/summary/equal_accuracy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "bench/summary/cost_at_error.hpp"
#include "bench/summary/curves.hpp"

namespace dmocbench {

namespace {

constexpr double steps_per_decade = 2.0;
constexpr std::array quantities{"state", "control"};
constexpr std::array costs{"intervals", "free_variables", "seconds"};

void append_rows(const std::vector<const Curve*>& methods, const std::string& quantity, double error, Table& table) {
  std::vector<Row> rows;
  std::map<std::string, double> of_dmoc;
  for (const Curve* curve : methods) {
    Row row;
    row.set("problem", curve->problem);
    row.set("tableau", curve->tableau);
    row.set("stages", curve->stages);
    row.set("quantity", quantity);
    row.set("error", error);
    row.set("method", curve->method);
    for (const std::string cost : costs) {
      const auto value = cost_at_error(error_cost_points(curve->rows, quantity + "_error", cost), error);
      if (!value) return;  // not every method reaches this error
      row.set(cost == "free_variables" ? "variables" : cost, *value);
      if (curve->method == "dmoc") of_dmoc[cost] = *value;
    }
    rows.push_back(std::move(row));
  }
  for (Row& row : rows) {
    if (!of_dmoc.empty()) {
      row.set("variables_ratio", *row.number("variables") / of_dmoc["free_variables"]);
      row.set("seconds_ratio", *row.number("seconds") / of_dmoc["seconds"]);
    }
    table.append(std::move(row));
  }
}

}  // namespace

Table equal_accuracy(const Table& convergence) {
  Table table({"problem", "tableau", "stages", "quantity", "error", "method", "intervals", "variables", "seconds",
               "variables_ratio", "seconds_ratio"});
  const std::vector<Curve> curves = curves_of(convergence);
  std::map<std::string, std::vector<const Curve*>> groups;
  for (const Curve& curve : curves) {
    groups[curve.problem + "," + curve.tableau + "," + curve.stages + "," + curve.solver].push_back(&curve);
  }
  for (const auto& [key, methods] : groups) {
    for (const std::string quantity : quantities) {
      double coarsest = -std::numeric_limits<double>::infinity();
      double finest = std::numeric_limits<double>::infinity();
      for (const Curve* curve : methods) {
        for (const ErrorCostPoint& point : error_cost_points(curve->rows, quantity + "_error", "seconds")) {
          coarsest = std::max(coarsest, point.error);
          finest = std::min(finest, point.error);
        }
      }
      if (!std::isfinite(coarsest)) continue;
      for (double k = std::floor(coarsest * steps_per_decade); k >= std::ceil(finest * steps_per_decade); --k) {
        append_rows(methods, quantity, std::pow(10.0, k / steps_per_decade), table);
      }
    }
  }
  return table;
}

}  // namespace dmocbench
