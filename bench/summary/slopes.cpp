#include "bench/summary/slopes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "bench/experiment/solve_case.hpp"
#include "bench/summary/curves.hpp"
#include "methods/diagnostics/convergence_order.hpp"

namespace dmocbench {

namespace {

constexpr long long reference_factor = 4;
/// Errors below this are the solver's tolerance (1e-10) and rounding, not the grid; relative to the cost for errors of
/// it. Used against a finer grid, where no floor can be measured.
constexpr double rounding_level = 1e-11;
/// Against an exact solution: how far above the floor an error tells the order, and how many such grids are a slope.
constexpr double above_floor = 100.0;
constexpr std::size_t fewest_grids = 4;

constexpr std::array fitted_quantities{"state",
                                       "control",
                                       "momentum",
                                       "costate",
                                       "objective",
                                       "replay",
                                       "control_from_costate",
                                       "stage_configuration",
                                       "stage_momentum",
                                       "stage_costate_q",
                                       "stage_costate_p"};

const std::vector<std::string> slope_columns{"problem",        "method", "tableau",  "stages", "quantity", "slope",
                                             "standard_error", "finest", "coarsest", "points", "floor",    "verdict"};

double number_of(const Row* row, const std::string& column) { return row->number(column).value_or(0.0); }

double smallest_error(const Row* row, const std::string& quantity) {
  return quantity == "objective" ? rounding_level * std::abs(number_of(row, "objective")) : rounding_level;
}

/// The errors of one quantity on the usable grids of a curve, coarsest first.
struct Errors {
  std::vector<GridError> points;
  std::vector<const Row*> rows;

  void add(const GridError& point, const Row* row) {
    points.push_back(point);
    rows.push_back(row);
  }
  [[nodiscard]] double intervals(std::size_t i) const { return number_of(rows[i], "intervals"); }
  /// Those that a predicate of their number keeps.
  template <class Predicate>
  [[nodiscard]] Errors where(const Predicate& keeps) const {
    Errors kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (keeps(i)) kept.add(points[i], rows[i]);
    }
    return kept;
  }
};

Errors errors_of(const Curve& curve, const std::string& column) {
  Errors errors;
  for (const Row* row : curve.rows) {
    const auto error = row->number(column);
    if (is_usable(*row) && error) errors.add({number_of(row, "step"), *error}, row);
  }
  return errors;
}

/// The number of intervals from which errors fall as their order says, measured: with the two-link it grows with the
/// order.
double asymptotic_from(const Curve& curve) {
  if (curve.problem == "orbital_transfer") return 16.0;
  if (curve.stages == "1") return 32.0;
  return curve.tableau == "gauss" && curve.stages == "4" ? 96.0 : 64.0;
}

Errors asymptotic_errors(const Curve& curve, const std::string& column) {
  const double start = asymptotic_from(curve);
  const Errors all = errors_of(curve, column);
  return all.where([&](std::size_t i) { return all.intervals(i) >= start; });
}

double order_between(const GridError& coarse, const GridError& fine) {
  return std::log(coarse.error / fine.error) / std::log(coarse.step / fine.step);
}

/// The order with which most of a curve falls: the upper quartile of the orders from grid to grid.
double typical_order(const std::vector<GridError>& points) {
  std::vector<double> orders;
  for (std::size_t i = 1; i < points.size(); ++i) orders.push_back(order_between(points[i - 1], points[i]));
  const auto quartile = orders.begin() + static_cast<std::ptrdiff_t>(orders.size() * 3 / 4);
  std::nth_element(orders.begin(), quartile, orders.end());
  return *quartile;
}

/// The median of the errors on a curve's finest grids, where they fall from grid to grid with less than half the
/// typical order; none if they fall to the end.
std::optional<double> measured_floor(const std::vector<GridError>& points) {
  if (points.size() < fewest_grids) return std::nullopt;
  const double half_order = typical_order(points) / 2.0;
  std::vector<double> flat;
  for (std::size_t i = points.size() - 1; i > 0 && !(order_between(points[i - 1], points[i]) >= half_order); --i) {
    flat.push_back(points[i].error);
  }
  if (flat.empty()) return std::nullopt;
  const auto middle = flat.begin() + static_cast<std::ptrdiff_t>(flat.size() / 2);
  std::nth_element(flat.begin(), middle, flat.end());
  return *middle;
}

/// The smallest measured floors, by problem, method and quantity.
using Floors = std::map<std::tuple<std::string, std::string, std::string>, double>;

Floors measured_floors(const std::vector<Curve>& curves) {
  Floors floors;
  for (const Curve& curve : curves) {
    for (const std::string quantity : fitted_quantities) {
      const auto floor = measured_floor(asymptotic_errors(curve, quantity + "_error").points);
      if (!floor) continue;
      const auto found = floors.try_emplace({curve.problem, curve.method, quantity}, *floor).first;
      found->second = std::min(found->second, *floor);
    }
  }
  return floors;
}

/// What is fitted, and what is said of it.
struct Fit {
  Errors errors;
  std::optional<double> floor;
  std::string verdict = "slope";
};

std::optional<double> floor_of(const Floors& floors, const Curve& curve, const std::string& quantity) {
  const auto found = floors.find({curve.problem, curve.method, quantity});
  return found == floors.end() ? std::nullopt : std::optional(found->second);
}

Fit above_the_floor(const Curve& curve, const std::string& column, const std::optional<double>& floor) {
  const Errors asymptotic = asymptotic_errors(curve, column);
  Fit fit;
  fit.floor = floor;
  const double limit = above_floor * floor.value_or(0.0);
  bool is_above = true;  // what lies behind the first grid at the floor is noise
  fit.errors = asymptotic.where([&](std::size_t i) {
    is_above = is_above && asymptotic.points[i].error > limit;
    return is_above;
  });
  if (fit.errors.points.size() < fewest_grids) {
    fit.verdict = fit.errors.points.size() < asymptotic.points.size() ? "floor" : "few grids";
  }
  return fit;
}

Fit in_range(const Curve& curve, const std::string& quantity, const FitRange& range) {
  const Errors all = errors_of(curve, quantity + "_error");
  Fit fit;
  fit.errors = all.where([&](std::size_t i) {
    return all.intervals(i) >= static_cast<double>(range.coarsest) &&
           all.intervals(i) <= static_cast<double>(range.finest) &&
           all.points[i].error >= smallest_error(all.rows[i], quantity);
  });
  return fit;
}

std::optional<Row> row_of(const Curve& curve, const std::string& quantity, const Fit& fit) {
  const auto order = fit.verdict == "floor" ? std::nullopt : fit_order(fit.errors.points);
  if (!order && fit.verdict != "floor") return std::nullopt;
  Row row;
  row.set("problem", curve.problem);
  row.set("method", curve.method);
  row.set("tableau", curve.tableau);
  row.set("stages", curve.stages);
  row.set("quantity", quantity);
  if (order) {
    row.set("slope", order->slope);
    if (order->points > 2) row.set("standard_error", order->standard_error);
    row.set("finest", fit.errors.intervals(fit.errors.points.size() - 1));
    row.set("coarsest", fit.errors.intervals(0));
  }
  row.set("points", static_cast<long long>(fit.errors.points.size()));
  row.set("floor", fit.floor);
  row.set("verdict", Cell(fit.verdict));
  return row;
}

/// The range against a finer grid, with a note where it goes too far.
FitRange range_against_grid(const Curve& curve, const std::optional<FitRange>& range, long long reference,
                            std::vector<std::string>& notes) {
  auto reference_intervals = static_cast<double>(reference);
  for (const Row* row : curve.rows) {
    if (reference <= 0) reference_intervals = std::max(reference_intervals, number_of(row, "intervals"));
  }
  if (!range) {
    constexpr long long one_stage = 32;
    constexpr long long several_stages = 64;
    return {curve.stages == "1" ? one_stage : several_stages,
            static_cast<long long>(reference_intervals) / reference_factor};
  }
  if (static_cast<double>(range->finest) * reference_factor > reference_intervals) {
    notes.push_back(
        fmt::format("{}: slopes are fitted up to N = {}, less than {} times coarser than the reference N = {}: "
                    "they are too large",
                    curve.label(), range->finest, reference_factor, reference_intervals));
  }
  return *range;
}

}  // namespace

SlopeTable fit_slopes(const Table& convergence, const std::optional<FitRange>& range, long long reference) {
  SlopeTable result{.table = Table(slope_columns), .notes = {}};
  const std::vector<Curve> curves = curves_of(convergence);
  const bool is_exact = reference == exact_reference;
  const Floors floors = is_exact ? measured_floors(curves) : Floors();
  for (const Curve& curve : curves) {
    const FitRange fitted =
        is_exact ? range.value_or(FitRange()) : range_against_grid(curve, range, reference, result.notes);
    for (const std::string quantity : fitted_quantities) {
      const Fit fit = is_exact && !range
                          ? above_the_floor(curve, quantity + "_error", floor_of(floors, curve, quantity))
                          : in_range(curve, quantity, fitted);
      if (auto row = row_of(curve, quantity, fit)) result.table.append(*std::move(row));
    }
  }
  return result;
}

Table fit_differences(const Table& equivalence, const std::string& quantity) {
  Table slopes(slope_columns);
  const std::vector<Curve> curves = curves_of(equivalence);
  std::map<std::string, double> floors;
  for (const Curve& curve : curves) {
    if (curve.method != "hamiltonian") continue;
    for (const GridError& point : errors_of(curve, quantity).points) {
      floors[curve.problem] = std::max(floors[curve.problem], point.error);
    }
  }
  for (const Curve& curve : curves) {
    const auto floor = floors.find(curve.problem);
    if (curve.method != "tangent" || floor == floors.end()) continue;
    const Fit fit = above_the_floor(curve, quantity, floor->second);
    if (auto row = row_of(curve, quantity, fit)) slopes.append(*std::move(row));
  }
  return slopes;
}

}  // namespace dmocbench
