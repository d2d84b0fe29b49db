#include "bench/summary/slopes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

constexpr std::array quantities{
    "state", "control", "momentum", "costate", "objective", "replay", "control_from_costate"};

double number_of(const Row* row, const std::string& column) { return row->number(column).value_or(0.0); }

double smallest_error(const Row* row, const std::string& quantity) {
  return quantity == "objective" ? rounding_level * std::abs(number_of(row, "objective")) : rounding_level;
}

double local_order(const GridError& coarse, const GridError& fine) {
  return std::log(coarse.error / fine.error) / std::log(coarse.step / fine.step);
}

/// The points, coarsest first, until the error falls much more slowly than it did before: there it is the solver's
/// tolerance, not the grid.
std::vector<GridError> above_solver_floor(std::vector<GridError> points) {
  constexpr double share = 2.0 / 3.0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    if (local_order(points[i - 1], points[i]) < share * local_order(points[i - 2], points[i - 1])) {
      points.resize(i);
    }
  }
  return points;
}

}  // namespace

SlopeTable fit_slopes(const Table& convergence, const std::optional<FitRange>& range, long long reference) {
  SlopeTable result;
  result.table = Table({"problem", "method", "tableau", "stages", "quantity", "slope", "standard_error", "finest",
                        "coarsest", "points"});
  for (const Curve& curve : curves_of(convergence)) {
    auto reference_intervals = static_cast<double>(reference);
    for (const Row* row : curve.rows) {
      if (reference <= 0) reference_intervals = std::max(reference_intervals, number_of(row, "intervals"));
    }
    FitRange fit;
    if (range) {
      fit = *range;
      if (reference != exact_reference && static_cast<double>(fit.finest) * reference_factor > reference_intervals) {
        result.notes.push_back(
            fmt::format("{}: slopes are fitted up to N = {}, less than {} times coarser than the reference N = {}: "
                        "they are too large",
                        curve.label(), fit.finest, reference_factor, reference_intervals));
      }
    } else {
      fit.coarsest = curve.stages == "1" ? asymptotic_from_one_stage : asymptotic_from_several_stages;
      const auto finest = static_cast<long long>(reference_intervals);
      fit.finest = reference == exact_reference ? finest : finest / reference_factor;
    }
    for (const std::string quantity : quantities) {
      std::vector<GridError> points;
      std::vector<double> grids;
      for (const Row* row : curve.rows) {
        const double intervals = number_of(row, "intervals");
        const auto error = row->number(quantity + "_error");
        const bool in_range =
            intervals >= static_cast<double>(fit.coarsest) && intervals <= static_cast<double>(fit.finest);
        if (!is_usable(*row) || !in_range || !error) continue;
        if (*error < smallest_error(row, quantity)) {
          if (reference == exact_reference) break;
          continue;
        }
        grids.push_back(intervals);
        points.push_back({number_of(row, "step"), *error});
      }
      if (reference == exact_reference && !range) points = above_solver_floor(std::move(points));
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
      row.set("finest", grids[points.size() - 1]);
      row.set("coarsest", grids.front());
      row.set("points", static_cast<long long>(order->points));
      result.table.append(std::move(row));
    }
  }
  return result;
}

}  // namespace dmocbench
