#include "bench/tables/fitted_orders.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/run/column.hpp"
#include "bench/run/solve_case.hpp"
#include "methods/diagnostics/convergence_order.hpp"
#include "methods/numerics/quantile.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

/// Smaller errors come from the solver's tolerance (1e-10) and rounding, not from the grid; relative to the cost for
/// errors of the cost. Used in a range of the user's.
constexpr double rounding_level = 1e-11;
/// The factor above the floor from which an error shows the order.
constexpr double above_floor = 100.0;

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
                                       "stage_costate_p",
                                       "first_order",
                                       "first_order_costate"};

/// Rows that agree in these differ in their grid only.
const ColumnNames curve_columns{"problem", "method", "tableau", "stages", "solver", "derivatives"};

/// The usable rows with an error, coarsest first. A control that is not determined has no order; the one from the
/// costate is determined by the costate alone.
Selection with_error(const Selection& curve, const std::string& column) {
  const bool is_of_control = column == "control_error";
  const auto is_known = [&](const Row& row) { return !is_of_control || has_known_control(row); };
  return curve.usable().with_number(column).where(is_known).sorted_by("intervals");
}

std::vector<GridError> errors_of(const Selection& rows, const std::string& column) {
  std::vector<GridError> errors;
  for (const Row& row : rows) errors.push_back({row.number("step", 0.0), row.number(column, 0.0)});
  return errors;
}

/// The median of the errors on the finest grids, where they fall with less than order 1/2 on the whole; empty if there
/// are less than two such grids.
std::optional<double> measured_floor(const std::vector<GridError>& errors, double reference) {
  constexpr double order_of_noise = 0.5;
  const std::vector<double> orders = neighbouring_orders(errors, reference);
  double fall = 0.0;
  double span = 0.0;
  std::vector<double> behind;  // the errors on all grids so far but the coarsest
  std::optional<double> floor;
  for (std::size_t i = orders.size(); i > 0 && std::isfinite(orders[i - 1]); --i) {
    const double step = std::log(errors[i - 1].step / errors[i].step);
    fall += orders[i - 1] * step;
    span += step;
    behind.push_back(errors[i].error);
    if (fall < order_of_noise * span) floor = median(behind);
  }
  return floor;
}

/// The smallest measured floor of some curves; `reference` is the step that their errors are measured against.
std::optional<double> smallest_floor(const std::vector<Selection>& curves, const std::string& column,
                                     double reference = 0.0) {
  std::optional<double> smallest;
  for (const Selection& curve : curves) {
    const auto floor = measured_floor(errors_of(with_error(curve, column), column), reference);
    if (floor) smallest = std::min(*floor, smallest.value_or(*floor));
  }
  return smallest;
}

/// The grids that are fitted, coarsest first.
struct Fit {
  Selection grids = {};
  std::optional<double> floor = std::nullopt;
  std::string verdict = "slope";
  double reference = 0.0;            ///< the step that errors are measured against; 0 for an exact solution
  std::string coarse_end = "range";  ///< why no coarser grid is fitted
  std::string fine_end = "range";    ///< why no finer grid is fitted
};

/// The asymptotic range of a curve (`asymptotic_range`) above its floor.
Fit above_the_floor(const Selection& curve, const std::string& column, const std::optional<double>& floor,
                    double reference = 0.0) {
  const Selection grids = with_error(curve, column);
  const double least = above_floor * floor.value_or(0.0);
  Fit fit{.floor = floor, .reference = reference};
  if (const auto range = asymptotic_range(errors_of(grids, column), least, reference)) {
    for (std::size_t i = range->first; i < range->end; ++i)
      fit.grids.append(*(grids.begin() + static_cast<std::ptrdiff_t>(i)));
    fit.coarse_end = name_of(range->coarse_end);
    fit.fine_end = name_of(range->fine_end);
    return fit;
  }
  bool is_above = true;  // errors after the first grid at the floor are noise
  fit.grids = grids.where([&](const Row& row) {
    is_above = is_above && row.number(column, 0.0) > least;
    return is_above;
  });
  fit.verdict = "unsteady";
  if (fit.grids.size() < fewest_grids) fit.verdict = fit.grids.size() < grids.size() ? "floor" : "few grids";
  return fit;
}

/// The grids of a range of the user's.
Fit in_range(const Selection& curve, const std::string& column, const FitRange& range) {
  Fit fit;
  fit.grids = with_error(curve, column).where([&](const Row& row) {
    const double scale = column == "objective_error" ? std::abs(row.number("objective", 0.0)) : 1.0;
    const double intervals = row.number("intervals", 0.0);
    return intervals >= static_cast<double>(range.coarsest) && intervals <= static_cast<double>(range.finest) &&
           row.number(column, 0.0) >= rounding_level * scale;
  });
  if (fit.grids.size() < fewest_in_range) fit.verdict = "few grids";
  return fit;
}

long long intervals_of(const Row& grid) { return static_cast<long long>(grid.number("intervals", 0.0)); }
long long finest_of(const Selection& grids) { return intervals_of(grids.back()); }
long long coarsest_of(const Selection& grids) { return intervals_of(grids.front()); }

/// A curve with the order of one of its quantities; empty unless the verdict is "slope".
struct FittedCurve {
  Row head;
  std::string quantity;
  Fit fit;
  std::string active = {};  ///< of the finest grid
  std::optional<FittedOrder> order = std::nullopt;

  /// The fit, if there is an order.
  [[nodiscard]] const Fit* fitted() const { return order ? &fit : nullptr; }
};

Columns<FittedCurve> order_columns() {
  using Curve = FittedCurve;
  return head_columns<Curve>(curve_columns, in_key) +
         Columns<Curve>{
             {"quantity", "", "error whose order is fitted: the column with this name and the suffix _error",
              &Curve::quantity, in_key},
             {"slope", "", "fitted order; empty if the verdict is not \"slope\"",
              from(&Curve::order, &FittedOrder::order)},
             {"standard_error", "", "standard error of the order", from(&Curve::order, standard_error_of)},
             {"finest", "", "largest number of intervals used", from(&Curve::fitted, &Fit::grids, finest_of)},
             {"coarsest", "", "smallest number of intervals used", from(&Curve::fitted, &Fit::grids, coarsest_of)},
             {"coarse_end", "",
              "reason for no coarser grid: grids (all are used), orders (they differ by more than 0.2), range (--fit)",
              from(&Curve::fitted, &Fit::coarse_end)},
             {"fine_end", "", "reason for no finer grid: grids, orders, range, or floor",
              from(&Curve::fitted, &Fit::fine_end)},
             {"points", "", "number of grids used", from(&Curve::fit, &Fit::grids, &Selection::size)},
             {"floor", "", "error at the level of round-off; empty if not measured", from(&Curve::fit, &Fit::floor)},
             {"verdict", "",
              "slope; floor (round-off leaves too few grids), few grids, or unsteady (no four neighbouring grids have "
              "the same order)",
              from(&Curve::fit, &Fit::verdict)},
             {"active", "",
              "quantities (controls, states) limited by active bounds and path constraints, which lower the orders",
              &Curve::active}};
}

/// Appends a fit, unless the quantity has no error on any grid.
void append_fit(std::vector<FittedCurve>& curves, const std::string& quantity, const std::string& column,
                const Fit& fit, const Selection& curve) {
  const Selection grids = with_error(curve, column);
  if (grids.empty()) return;
  FittedCurve& fitted = curves.emplace_back(
      FittedCurve{.head = curve.front(), .quantity = quantity, .fit = fit, .active = grids.back().text("active")});
  if (fit.verdict == "slope") fitted.order = fit_order(errors_of(fit.grids, column), fit.reference);
}

/// The row of the grid that a curve's errors should be measured against: the one named, or the finest.
Row reference_meant(const Selection& curve, long long reference) {
  const Selection named = curve.where("intervals", std::to_string(reference));
  return named.empty() ? curve.sorted_by("intervals").back() : named.front();
}

/// The row of the grid that they are measured against; none where there is no answer.
std::optional<Row> reference_used(const Selection& curve, long long reference) {
  const Row meant = reference_meant(curve, reference);
  if (is_usable(meant)) return meant;
  const Selection usable = curve.usable().sorted_by("intervals");
  return reference != 0 || usable.empty() ? std::nullopt : std::optional(usable.back());
}

/// Where a curve's reference is another than the one meant, or there is none: what happened to that one.
std::optional<std::string> note_on_reference(const Selection& curve, long long reference) {
  const Row meant = reference_meant(curve, reference);
  if (is_usable(meant)) return std::nullopt;
  const std::optional<Row> used = reference_used(curve, reference);
  const std::string& status = meant.text("status");
  return fmt::format(
      "{} {} {} {}: the reference should be N = {}, which {}; {}", meant.text("problem"), meant.text("method"),
      meant.text("tableau"), meant.text("stages"), meant.text("intervals"),
      has_solved_status(meant) ? "is on a different branch from the common start" : "has the status \"" + status + "\"",
      used ? fmt::format("errors are measured against N = {}, the finest solved grid", used->text("intervals"))
      : reference != 0 ? "no errors are computed; choose a --reference that is solved"
                       : "no errors are computed because no grid is solved");
}

/// Why a curve has no order at all, if it has errors that one could be fitted to.
std::optional<std::string> note_on_missing_orders(std::span<const FittedCurve> fits) {
  const bool has_order = std::ranges::any_of(fits, [](const FittedCurve& fit) { return fit.order.has_value(); });
  if (fits.empty() || has_order) return std::nullopt;
  // Coordinates that stay at rest next to first-order states have no error at all, and no floor of it.
  const auto has_reason = [](const FittedCurve& curve) { return curve.fit.verdict != "floor" || curve.fit.floor; };
  const auto explained = std::ranges::find_if(fits, has_reason);
  const Row& head = fits.front().head;
  const Fit& fit = explained == fits.end() ? fits.front().fit : explained->fit;
  const std::string grids = counted(fit.grids.size(), "grid");
  std::string reason = "no four neighbouring grids have the same order; try finer grids";
  if (explained == fits.end()) {
    reason = "the errors are 0: every grid has the solution of the reference";
  } else if (fit.verdict == "few grids") {
    reason = grids + "; use at least four grids besides the reference, all solved and not too coarse";
  } else if (fit.verdict == "floor") {
    reason = fmt::format(
        "the {} error stops falling at {:.1e}, and {} above {:g} times this level; use coarser grids. If the level is "
        "far above round-off, reduce --tolerance, or add a small cost on each undetermined control",
        explained->quantity, *fit.floor, counted(fit.grids.size(), "grid is", "grids are"), above_floor);
  }
  return fmt::format("{} {} {} {}: no order is fitted ({}: {})", head.text("problem"), head.text("method"),
                     head.text("tableau"), head.text("stages"), fit.verdict, reason);
}

/// The orders of a curve's largest jump and of its state error on the same grids.
struct TwoOrders {
  FittedOrder jump;
  FittedOrder error;
  Selection grids;
};

struct JumpsOfCurve {
  Row head;
  std::optional<TwoOrders> orders = {};
  std::size_t points = 0;
  std::string verdict;
};

constexpr const char* jump_column = "largest_jump";
constexpr const char* error_column = "state_error";

double error_of_jumps(const Row& grid) {
  return grid.number(error_column, 0.0) / (grid.number("intervals", 0.0) * grid.number(jump_column, 0.0));
}

Columns<JumpsOfCurve> jump_columns() {
  constexpr auto orders = &JumpsOfCurve::orders;
  return head_columns<JumpsOfCurve>(curve_columns, in_key) +
         Columns<JumpsOfCurve>{
             {"jump_slope", "", "fitted order of the largest jump of an interval",
              from(orders, &TwoOrders::jump, &FittedOrder::order)},
             {"jump_standard_error", "", "standard error of this order",
              from(orders, &TwoOrders::jump, standard_error_of)},
             {"error_slope", "", "fitted order of the state error on the same grids",
              from(orders, &TwoOrders::error, &FittedOrder::order)},
             {"error_standard_error", "", "standard error of this order",
              from(orders, &TwoOrders::error, standard_error_of)},
             {"orders_apart", "", "jump_slope minus error_slope",
              from(orders, [](const TwoOrders& both) { return both.jump.order - both.error.order; })},
             {"error_of_jumps_coarsest", "", "state error / (N times the jump) on the coarsest grid",
              from(orders, &TwoOrders::grids, &Selection::front, error_of_jumps)},
             {"error_of_jumps_finest", "", "state error / (N times the jump) on the finest grid",
              from(orders, &TwoOrders::grids, &Selection::back, error_of_jumps)},
             {"coarsest", "", "smallest number of intervals used", from(orders, &TwoOrders::grids, coarsest_of)},
             {"finest", "", "largest number of intervals used", from(orders, &TwoOrders::grids, finest_of)},
             {"points", "", "number of grids used", &JumpsOfCurve::points},
             {"verdict", "", "slope, floor (round-off leaves too few grids) or few grids", &JumpsOfCurve::verdict}};
}

}  // namespace

FittedOrders fit_orders(const Selection& convergence, const std::optional<FitRange>& range, long long reference) {
  std::vector<FittedCurve> curves;
  std::vector<std::string> notes;
  bool has_order_everywhere = true;
  for (const Selection& curve : convergence.group_by(curve_columns)) {
    const auto of_the_method = convergence.matching(curve.front(), {"problem", "method"}).group_by(curve_columns);
    const bool has_exact = reference == exact_reference;
    const std::optional<Row> used = has_exact ? std::nullopt : reference_used(curve, reference);
    const double step = used ? used->number("step", 0.0) : 0.0;
    if (const auto note = has_exact ? std::nullopt : note_on_reference(curve, reference)) notes.push_back(*note);
    const std::size_t fits_before = curves.size();
    for (const std::string quantity : fitted_quantities) {
      const std::string column = quantity + "_error";
      Fit fit = range ? in_range(curve, column, *range)
                      : above_the_floor(curve, column, smallest_floor(of_the_method, column, step), step);
      fit.reference = step;
      append_fit(curves, quantity, column, fit, curve);
    }
    if (const auto note = note_on_missing_orders(std::span(curves).subspan(fits_before))) {
      notes.push_back(*note);
      has_order_everywhere = false;
    }
  }
  std::vector<std::string> unsteady;
  for (const FittedCurve& curve : curves) {
    if (curve.fit.verdict == "unsteady" && std::ranges::count(unsteady, curve.quantity) == 0)
      unsteady.push_back(curve.quantity);
  }
  if (has_order_everywhere && !unsteady.empty()) {
    notes.push_back(fmt::format("unsteady ({}): no four neighbouring grids have the same order; try finer grids",
                                fmt::join(unsteady, ", ")));
  }
  return {.table = table_of(order_columns(), curves), .notes = std::move(notes)};
}

Table fit_jumps(const Selection& convergence) {
  std::vector<JumpsOfCurve> curves;
  for (const Selection& curve : convergence.group_by(curve_columns)) {
    const auto of_the_method = convergence.matching(curve.front(), {"problem", "method"}).group_by(curve_columns);
    const Fit jumps = above_the_floor(curve, jump_column, smallest_floor(of_the_method, jump_column));
    if (jumps.grids.empty()) continue;
    const Fit both = above_the_floor(jumps.grids, error_column, smallest_floor(of_the_method, error_column));
    const bool are_few_jumps = both.grids.size() < fewest_grids && jumps.verdict != "slope";
    JumpsOfCurve& fitted = curves.emplace_back(JumpsOfCurve{
        .head = curve.front(), .points = both.grids.size(), .verdict = are_few_jumps ? jumps.verdict : both.verdict});
    const auto jump_order = fit_order(errors_of(both.grids, jump_column));
    const auto error_order = fit_order(errors_of(both.grids, error_column));
    if (jump_order && error_order) fitted.orders = {*jump_order, *error_order, both.grids};
  }
  return table_of(jump_columns(), curves);
}

Table fit_differences(const Selection& equivalence, const std::string& column) {
  std::vector<FittedCurve> curves;
  for (const Selection& curve : equivalence.where("method", "tangent").group_by(curve_columns)) {
    const Selection hamiltonian = equivalence.matching(curve.front(), {"problem"}).where("method", "hamiltonian");
    const Selection rounded = hamiltonian.usable().with_number(column);
    if (rounded.empty()) continue;
    append_fit(curves, column, column, above_the_floor(curve, column, rounded.max(column)), curve);
  }
  return table_of(order_columns(), curves);
}

bool has_solution_of_dmoc(const Row& row) {
  constexpr double tolerance = 1e-10;
  const auto leaves_rounding = [&](const char* violation, const char* rounding) {
    return row.needed(violation) < std::max(tolerance, row.needed(rounding));
  };
  return leaves_rounding("violation_in_rows_of_dmoc", "rounding_in_rows_of_dmoc") &&
         leaves_rounding("violation_of_dmoc_here", "rounding_here");
}

}  // namespace dmocbench
