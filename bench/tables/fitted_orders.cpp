#include "bench/tables/fitted_orders.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/run/column.hpp"
#include "methods/diagnostics/convergence_order.hpp"
#include "methods/numerics/median.hpp"

namespace dmocbench {

namespace {

constexpr long long reference_factor = 4;
/// Smaller errors come from the solver's tolerance (1e-10) and rounding, not from the grid; relative to the cost for
/// errors of the cost. Used against a finer grid, where no floor can be measured.
constexpr double rounding_level = 1e-11;
/// Against an exact solution: how far above the floor an error shows the order, and how many such grids make a fit.
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

const ColumnNames scheme_names{"problem", "method", "tableau", "stages"};
/// Rows that agree in these differ in their grid only.
const ColumnNames curve_columns{"problem", "method", "tableau", "stages", "solver", "derivatives"};

/// The number of intervals from which errors fall as their order says. It was found by trial: for the two-link
/// manipulator it grows with the order.
double asymptotic_from(const Row& head) {
  if (head.text("problem") == "orbital_transfer") return 16.0;
  if (head.text("stages") == "1") return 32.0;
  return head.text("tableau") == "gauss" && head.text("stages") == "4" ? 96.0 : 64.0;
}

/// The usable rows with an error on grids of so many intervals.
Selection with_error(const Selection& curve, const std::string& column, double coarsest,
                     double finest = std::numeric_limits<double>::infinity()) {
  return curve.usable().with_number(column).where([&](const Row& row) {
    const double intervals = row.number("intervals", 0.0);
    return intervals >= coarsest && intervals <= finest;
  });
}

std::vector<GridError> errors_of(const Selection& rows, const std::string& column) {
  std::vector<GridError> errors;
  for (const Row& row : rows) errors.push_back({row.number("step", 0.0), row.number(column, 0.0)});
  return errors;
}

/// The median of the errors on the finest grids, where they fall from grid to grid with less than half the upper
/// quartile of all such orders; none if they fall to the end.
std::optional<double> measured_floor(const std::vector<GridError>& errors) {
  if (errors.size() < fewest_grids) return std::nullopt;
  std::vector<double> orders;
  for (std::size_t i = 1; i < errors.size(); ++i) {
    orders.push_back(std::log(errors[i - 1].error / errors[i].error) / std::log(errors[i - 1].step / errors[i].step));
  }
  std::vector<double> sorted = orders;
  const auto quartile = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 3 / 4);
  std::ranges::nth_element(sorted, quartile);
  std::vector<double> flat;
  for (std::size_t i = orders.size(); i > 0 && !(orders[i - 1] >= *quartile / 2.0); --i) {
    flat.push_back(errors[i].error);
  }
  return flat.empty() ? std::nullopt : std::optional(median(flat));
}

/// The smallest measured floor of some curves.
std::optional<double> smallest_floor(const std::vector<Selection>& curves, const std::string& column) {
  std::optional<double> smallest;
  for (const Selection& curve : curves) {
    const auto floor = measured_floor(errors_of(with_error(curve, column, asymptotic_from(curve.front())), column));
    if (floor) smallest = std::min(*floor, smallest.value_or(*floor));
  }
  return smallest;
}

/// The grids that are fitted, coarsest first.
struct Fit {
  Selection grids;
  std::optional<double> floor = std::nullopt;
  std::string verdict = "slope";
};

Fit above_the_floor(const Selection& curve, const std::string& column, const std::optional<double>& floor) {
  const Selection asymptotic = with_error(curve, column, asymptotic_from(curve.front()));
  const double limit = above_floor * floor.value_or(0.0);
  bool is_above = true;  // errors behind the first grid at the floor are noise
  Fit fit{.grids = asymptotic.where([&](const Row& row) {
            is_above = is_above && row.number(column, 0.0) > limit;
            return is_above;
          }),
          .floor = floor};
  if (fit.grids.size() < fewest_grids) fit.verdict = fit.grids.size() < asymptotic.size() ? "floor" : "few grids";
  return fit;
}

Fit in_range(const Selection& curve, const std::string& column, const FitRange& range) {
  const auto coarsest = static_cast<double>(range.coarsest);
  const auto finest = static_cast<double>(range.finest);
  return {.grids = with_error(curve, column, coarsest, finest).where([&](const Row& row) {
    const double scale = column == "objective_error" ? std::abs(row.number("objective", 0.0)) : 1.0;
    return row.number(column, 0.0) >= rounding_level * scale;
  })};
}

long long intervals_of(const Row& grid) { return static_cast<long long>(grid.number("intervals", 0.0)); }
long long finest_of(const Selection& grids) { return intervals_of(grids.back()); }
long long coarsest_of(const Selection& grids) { return intervals_of(grids.front()); }

/// A curve with the order of one of its quantities; none at the floor.
struct FittedCurve {
  Row head;
  std::string quantity;
  Fit fit;
  std::optional<FittedOrder> order = std::nullopt;

  /// The grids, if an order was fitted to them.
  [[nodiscard]] const Selection* fitted_grids() const { return order ? &fit.grids : nullptr; }
};

Columns<FittedCurve> order_columns() {
  using Curve = FittedCurve;
  return head_columns<Curve>(scheme_names, in_key) +
         Columns<Curve>{
             {"quantity", "", "the error whose order is fitted: the column of that name with _error behind it",
              &Curve::quantity, in_key},
             {"slope", "", "fitted order; empty where the verdict is not \"slope\"",
              from(&Curve::order, &FittedOrder::order)},
             {"standard_error", "", "of the order; empty with two points", from(&Curve::order, standard_error_of)},
             {"finest", "", "largest number of intervals used", from(&Curve::fitted_grids, finest_of)},
             {"coarsest", "", "smallest number of intervals used", from(&Curve::fitted_grids, coarsest_of)},
             {"points", "", "number of grids used", from(&Curve::fit, &Fit::grids, &Selection::size)},
             {"floor", "", "error at which rounding begins; empty where none was measured",
              from(&Curve::fit, &Fit::floor)},
             {"verdict", "", "slope, floor (rounding leaves too few grids) or few grids",
              from(&Curve::fit, &Fit::verdict)}};
}

/// Appends a fit, unless there is nothing to say.
void append_fit(std::vector<FittedCurve>& curves, const std::string& quantity, const std::string& column,
                const Fit& fit, const Row& head) {
  FittedCurve curve{.head = head, .quantity = quantity, .fit = fit};
  if (fit.verdict != "floor") curve.order = fit_order(errors_of(fit.grids, column));
  if (curve.order || fit.verdict == "floor") curves.push_back(std::move(curve));
}

/// The range against a finer grid, with a note where it goes too far.
FitRange range_against_grid(const Selection& curve, const std::optional<FitRange>& range, long long reference,
                            std::vector<std::string>& notes) {
  const Row& head = curve.front();
  const auto finest = static_cast<long long>(curve.sorted_by("intervals").back().number("intervals", 0.0));
  const long long reference_intervals = reference > 0 ? reference : finest;
  if (range && range->finest * reference_factor > reference_intervals) {
    notes.push_back(
        fmt::format("{} {} {} {}: slopes are fitted up to N = {}, less than {} times coarser than the reference N = "
                    "{}: they are too large",
                    head.text("problem"), head.text("method"), head.text("tableau"), head.text("stages"), range->finest,
                    reference_factor, reference_intervals));
  }
  return range.value_or(FitRange{head.text("stages") == "1" ? 32 : 64, reference_intervals / reference_factor});
}

/// Why a curve has no order at all, if it has errors that one could be fitted to.
void note_missing_orders(const Selection& curve, const FitRange& range, std::vector<std::string>& notes) {
  const Row& head = curve.front();
  if (curve.with_number("state_error").empty()) return;
  notes.push_back(fmt::format(
      "{} {} {} {}: no order is fitted, which takes two grids from N = {} to {}; solve on more grids or say "
      "--fit a:b",
      head.text("problem"), head.text("method"), head.text("tableau"), head.text("stages"), range.coarsest,
      range.finest));
}

/// The orders of a curve's largest jump and of its state error on the same grids.
struct TwoOrders {
  FittedOrder jump;
  FittedOrder error;
  Selection grids;
};

struct JumpsOfCurve {
  Row head;
  std::optional<TwoOrders> orders;
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
  return head_columns<JumpsOfCurve>(scheme_names, in_key) +
         Columns<JumpsOfCurve>{
             {"jump_slope", "", "fitted order of the largest jump of an interval that is replayed alone",
              from(orders, &TwoOrders::jump, &FittedOrder::order)},
             {"jump_standard_error", "", "of that order", from(orders, &TwoOrders::jump, standard_error_of)},
             {"error_slope", "", "fitted order of the state error on the same grids",
              from(orders, &TwoOrders::error, &FittedOrder::order)},
             {"error_standard_error", "", "of that order", from(orders, &TwoOrders::error, standard_error_of)},
             {"orders_apart", "", "jump_slope minus error_slope",
              from(orders, [](const TwoOrders& both) { return both.jump.order - both.error.order; })},
             {"error_of_jumps_coarsest", "", "state error by N times the jump on the coarsest grid",
              from(orders, &TwoOrders::grids, &Selection::front, error_of_jumps)},
             {"error_of_jumps_finest", "", "the same on the finest grid",
              from(orders, &TwoOrders::grids, &Selection::back, error_of_jumps)},
             {"coarsest", "", "smallest number of intervals used", from(orders, &TwoOrders::grids, coarsest_of)},
             {"finest", "", "largest number of intervals used", from(orders, &TwoOrders::grids, finest_of)},
             {"points", "", "number of grids used", &JumpsOfCurve::points},
             {"verdict", "", "slope, floor (rounding leaves too few grids) or few grids", &JumpsOfCurve::verdict}};
}

}  // namespace

FittedOrders fit_orders(const Selection& convergence, const std::optional<FitRange>& range, long long reference) {
  std::vector<FittedCurve> curves;
  std::vector<std::string> notes;
  const bool is_exact = reference == exact_reference;
  for (const Selection& curve : convergence.group_by(curve_columns)) {
    const Row& head = curve.front();
    const auto of_the_method = convergence.matching(head, {"problem", "method"}).group_by(curve_columns);
    const FitRange fitted = is_exact ? range.value_or(FitRange()) : range_against_grid(curve, range, reference, notes);
    const std::size_t fits_before = curves.size();
    for (const std::string quantity : fitted_quantities) {
      const std::string column = quantity + "_error";
      const Fit fit = is_exact && !range ? above_the_floor(curve, column, smallest_floor(of_the_method, column))
                                         : in_range(curve, column, fitted);
      append_fit(curves, quantity, column, fit, head);
    }
    const bool has_range = !is_exact || range.has_value();
    if (has_range && curves.size() == fits_before) note_missing_orders(curve, fitted, notes);
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
    JumpsOfCurve& fitted = curves.emplace_back(JumpsOfCurve{.head = curve.front(),
                                                            .orders = std::nullopt,
                                                            .points = both.grids.size(),
                                                            .verdict = are_few_jumps ? jumps.verdict : both.verdict});
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
    append_fit(curves, column, column, above_the_floor(curve, column, rounded.max(column)), curve.front());
  }
  return table_of(order_columns(), curves);
}

}  // namespace dmocbench
