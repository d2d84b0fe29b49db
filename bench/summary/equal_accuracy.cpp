#include "bench/summary/equal_accuracy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "bench/experiment/solve_case.hpp"
#include "bench/summary/curves.hpp"

namespace dmocbench {

namespace {

constexpr double steps_per_decade = 2.0;
constexpr std::array quantities{"state", "control"};
constexpr std::array costs{"intervals", "free_variables", "seconds"};

/// Error and cost of one grid, as logarithms.
struct Point {
  double error;
  double cost;
};

std::vector<Point> points_of(const Curve& curve, const std::string& quantity, const std::string& cost) {
  std::vector<Point> points;
  for (const Row* row : curve.rows) {
    const auto error = row->number(quantity + "_error");
    const auto value = row->number(cost);
    if (is_usable(*row) && error && value && *error > 0.0 && *value > 0.0) {
      points.push_back({std::log10(*error), std::log10(*value)});
    }
  }
  return points;
}

/// The cost at which the curve reaches the error; none outside of its grids.
std::optional<double> cost_at(const std::vector<Point>& points, double error) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point& a = points[i];
    const Point& b = points[i + 1];
    if (error > a.error || error < b.error || a.error == b.error) continue;
    const double weight = (error - a.error) / (b.error - a.error);
    return std::pow(10.0, a.cost + weight * (b.cost - a.cost));
  }
  return std::nullopt;
}

void append_rows(const std::vector<const Curve*>& methods, const std::string& quantity, double error, Table& table) {
  std::vector<Row> rows;
  std::map<std::string, double> of_dmoc;
  for (const Curve* curve : methods) {
    Row row;
    row.set("problem", curve->problem);
    row.set("tableau", curve->tableau);
    row.set("stages", curve->stages);
    row.set("quantity", quantity);
    row.set("error", std::pow(10.0, error));
    row.set("method", curve->method);
    for (const std::string cost : costs) {
      const auto value = cost_at(points_of(*curve, quantity, cost), error);
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
        for (const Point& point : points_of(*curve, quantity, "seconds")) {
          coarsest = std::max(coarsest, point.error);
          finest = std::min(finest, point.error);
        }
      }
      if (!std::isfinite(coarsest)) continue;
      for (double k = std::floor(coarsest * steps_per_decade); k >= std::ceil(finest * steps_per_decade); --k) {
        append_rows(methods, quantity, k / steps_per_decade, table);
      }
    }
  }
  return table;
}

}  // namespace dmocbench
