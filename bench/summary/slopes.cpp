#include "bench/summary/slopes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "bench/experiment/solve_case.hpp"
#include "bench/summary/curves.hpp"
#include "methods/diagnostics/convergence_order.hpp"

namespace dmocbench {

namespace {

constexpr long long asymptotic_from_one_stage = 32;
constexpr long long asymptotic_from_several_stages = 64;
constexpr long long reference_factor = 4;
/// Errors below this are the solver's tolerance (1e-10) and rounding, not the grid; relative to the cost for errors of
/// it.
constexpr double rounding_level = 1e-11;

constexpr std::array quantities{"state", "control", "momentum", "costate", "objective", "replay"};

double number_of(const Row* row, const std::string& column) { return row->number(column).value_or(0.0); }

double smallest_error(const Row* row, const std::string& quantity) {
  return quantity == "objective" ? rounding_level * std::abs(number_of(row, "objective")) : rounding_level;
}

}  // namespace

SlopeTable fit_slopes(const Table& convergence, const std::optional<FitRange>& range, long long reference) {
  SlopeTable result;
  result.table = Table({"problem", "method", "tableau", "stages", "quantity", "slope", "standard_error", "finest",
                        "coarsest", "points"});
  for (const Curve& curve : curves_of(convergence)) {
    auto reference_intervals = static_cast<double>(reference);
    for (const Row* row : curve.rows) {
      if (reference == 0) reference_intervals = std::max(reference_intervals, number_of(row, "intervals"));
    }
    FitRange fit;
    if (range) {
      fit = *range;
      if (static_cast<double>(fit.finest) * reference_factor > reference_intervals) {
        result.notes.push_back(
            fmt::format("{}: slopes are fitted up to N = {}, less than {} times coarser than the reference N = {}: "
                        "they are too large",
                        curve.label(), fit.finest, reference_factor, reference_intervals));
      }
    } else {
      fit.coarsest = curve.stages == "1" ? asymptotic_from_one_stage : asymptotic_from_several_stages;
      fit.finest = static_cast<long long>(reference_intervals) / reference_factor;
    }
    for (const std::string quantity : quantities) {
      std::vector<GridError> points;
      double coarsest = 0.0;
      double finest = 0.0;
      for (const Row* row : curve.rows) {
        const double intervals = number_of(row, "intervals");
        const auto error = row->number(quantity + "_error");
        const bool in_range =
            intervals >= static_cast<double>(fit.coarsest) && intervals <= static_cast<double>(fit.finest);
        if (!is_usable(*row) || !in_range || !error || *error < smallest_error(row, quantity)) continue;
        if (coarsest == 0.0) coarsest = intervals;
        finest = intervals;
        points.push_back({number_of(row, "step"), *error});
      }
      const auto order = fit_order(points);
      if (!order) continue;
      Row row;
      row.set("problem", curve.problem);
      row.set("method", curve.method);
      row.set("tableau", curve.tableau);
      row.set("stages", curve.stages);
      row.set("quantity", quantity);
      row.set("slope", order->slope);
      if (order->points > 2) row.set("standard_error", order->standard_error);
      row.set("finest", finest);
      row.set("coarsest", coarsest);
      row.set("points", static_cast<long long>(order->points));
      result.table.append(std::move(row));
    }
  }
  return result;
}

}  // namespace dmocbench
