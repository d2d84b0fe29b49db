#include "bench/summary/fitted_orders.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/summary/column_meanings.hpp"
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

const ColumnNames table_columns{"problem",        "method", "tableau",  "stages", "quantity", "slope",
                                "standard_error", "finest", "coarsest", "points", "floor",    "verdict"};
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

/// Appends the row of a fit, unless there is nothing to say.
void append_fit(Table& table, const std::string& quantity, const std::string& column, const Fit& fit, const Row& head) {
  const bool is_floor = fit.verdict == "floor";
  const auto order = is_floor ? std::nullopt : fit_order(errors_of(fit.grids, column));
  if (!order && !is_floor) return;
  Row row = fields_of(head, {"problem", "method", "tableau", "stages"});
  row.set("quantity", quantity);
  if (order) {
    row.set("slope", order->order);
    if (order->points > 2) row.set("standard_error", order->standard_error);
    row.set("finest", fit.grids.back().text("intervals"));
    row.set("coarsest", fit.grids.front().text("intervals"));
  }
  row.set("points", fit.grids.size());
  row.set("floor", fit.floor);
  row.set("verdict", fit.verdict);
  table.append(std::move(row));
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

}  // namespace

FittedOrders fit_orders(const Selection& convergence, const std::optional<FitRange>& range, long long reference) {
  FittedOrders result{.table = Table(table_columns), .notes = {}};
  explain(result.table, meanings_in_orders());
  const bool is_exact = reference == exact_reference;
  for (const Selection& curve : convergence.group_by(curve_columns)) {
    const Row& head = curve.front();
    const auto of_the_method = convergence.matching(head, {"problem", "method"}).group_by(curve_columns);
    const FitRange fitted =
        is_exact ? range.value_or(FitRange()) : range_against_grid(curve, range, reference, result.notes);
    const std::size_t fits_before = result.table.rows().size();
    for (const std::string quantity : fitted_quantities) {
      const std::string column = quantity + "_error";
      const Fit fit = is_exact && !range ? above_the_floor(curve, column, smallest_floor(of_the_method, column))
                                         : in_range(curve, column, fitted);
      append_fit(result.table, quantity, column, fit, head);
    }
    const bool has_range = !is_exact || range.has_value();
    if (has_range && result.table.rows().size() == fits_before) note_missing_orders(curve, fitted, result.notes);
  }
  return result;
}

Table fit_jumps(const Selection& convergence) {
  const std::string jump = "largest_jump";
  const std::string error = "state_error";
  Table table({"problem", "method", "tableau", "stages", "jump_slope", "jump_standard_error", "error_slope",
               "error_standard_error", "orders_apart", "error_of_jumps_coarsest", "error_of_jumps_finest", "coarsest",
               "finest", "points", "verdict"});
  explain(table, meanings_in_orders());
  for (const Selection& curve : convergence.group_by(curve_columns)) {
    const auto of_the_method = convergence.matching(curve.front(), {"problem", "method"}).group_by(curve_columns);
    const Fit jumps = above_the_floor(curve, jump, smallest_floor(of_the_method, jump));
    if (jumps.grids.empty()) continue;
    const Fit both = above_the_floor(jumps.grids, error, smallest_floor(of_the_method, error));
    Row row = fields_of(curve.front(), {"problem", "method", "tableau", "stages"});
    row.set("points", both.grids.size());
    row.set("verdict", both.grids.size() < fewest_grids && jumps.verdict != "slope" ? jumps.verdict : both.verdict);
    const auto jump_order = fit_order(errors_of(both.grids, jump));
    const auto error_order = fit_order(errors_of(both.grids, error));
    if (jump_order && error_order) {
      const auto error_of_jumps = [&](const Row& grid) {
        return grid.number(error, 0.0) / (grid.number("intervals", 0.0) * grid.number(jump, 0.0));
      };
      row.set("jump_slope", jump_order->order);
      row.set("error_slope", error_order->order);
      if (jump_order->points > 2) {
        row.set("jump_standard_error", jump_order->standard_error);
        row.set("error_standard_error", error_order->standard_error);
      }
      row.set("orders_apart", jump_order->order - error_order->order);
      row.set("error_of_jumps_coarsest", error_of_jumps(both.grids.front()));
      row.set("error_of_jumps_finest", error_of_jumps(both.grids.back()));
      row.set("coarsest", both.grids.front().text("intervals"));
      row.set("finest", both.grids.back().text("intervals"));
    }
    table.append(std::move(row));
  }
  return table;
}

Table fit_differences(const Selection& equivalence, const std::string& column) {
  Table table(table_columns);
  explain(table, meanings_in_orders());
  for (const Selection& curve : equivalence.where("method", "tangent").group_by(curve_columns)) {
    const Selection hamiltonian = equivalence.matching(curve.front(), {"problem"}).where("method", "hamiltonian");
    const Selection rounded = hamiltonian.usable().with_number(column);
    if (rounded.empty()) continue;
    append_fit(table, column, column, above_the_floor(curve, column, rounded.max(column)), curve.front());
  }
  return table;
}

}  // namespace dmocbench
