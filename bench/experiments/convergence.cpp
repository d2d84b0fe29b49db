// Errors over the step: fig:kepler_error and fig:twolink_error of the paper, and the cost of accuracy.
#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiments/convergence/situation.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/indirect_reference.hpp"
#include "bench/tables/fitted_orders.hpp"
#include "bench/tables/ratios.hpp"
#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/error.hpp"
#include "methods/indirect/control_from_costate.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench::convergence_program {

/// The value of --reference: N, 0 for the finest solved grid of each curve, or `exact_reference`.
long long parse_reference(const std::string& text) {
  if (text.empty()) return 0;
  if (text == "indirect") return exact_reference;
  const auto intervals = parsed<long long>(text);
  if (intervals && *intervals > 0) return *intervals;
  throw Error("--reference takes a number of intervals or indirect, not {}", text);
}

long long intervals_of(const Case& the_case) { return static_cast<long long>(the_case.intervals()); }

struct Measured {
  std::optional<TrajectoryError> error;
  std::optional<double> control_from_costate_error;
  std::optional<ReplayError> replay;
  std::optional<int> polish_steps;
  std::string active;
  std::vector<double> round_seconds;
};

/// A row per curve: for each error the fitted order and the grids that it is fitted over, or why it is missing; and
/// whether bounds are active, which lower orders.
Table orders_by_curve(const Table& orders) {
  std::vector<std::string> quantities{"state", "momentum", "control", "costate", "objective"};
  if (!Selection(orders).where("quantity", "first_order").empty()) {
    quantities.insert(quantities.end(), {"first_order", "first_order_costate"});
  }
  std::vector<std::string> columns{"problem", "method", "tableau", "s"};
  columns.insert(columns.end(), quantities.begin(), quantities.end());
  const bool has_bounds =
      std::ranges::any_of(orders.rows(), [](const Row& row) { return !row.text("active").empty(); });
  if (has_bounds) columns.emplace_back("active bounds");
  Table summary(columns);
  summary.set_key({"problem", "method", "tableau", "s", "solver", "derivatives"});
  for (const Selection& curve :
       Selection(orders).group_by({"problem", "method", "tableau", "stages", "solver", "derivatives"})) {
    Row row = fields_of(curve.front(), summary.key());
    row.set("s", curve.front().text("stages"));
    for (const std::string& quantity : quantities) {
      const Selection fitted = curve.where("quantity", quantity);
      if (fitted.empty()) continue;
      const Row& fit = fitted.front();
      row.set(quantity, fit.text("verdict") != "slope" ? fit.text("verdict")
                                                       : fmt::format("{:.2f} ({}:{})", fit.needed("slope"),
                                                                     fit.text("coarsest"), fit.text("finest")));
    }
    if (has_bounds) row.set("active bounds", curve.front().text("active"));
    summary.append(std::move(row));
  }
  return summary;
}

class Convergence final : public ExperimentOf<Measured> {
 public:
  Convergence()
      : ExperimentOf({.name = "convergence",
                      .description = "Measures errors of state, control, momentum, costate and cost relative to a fine "
                                     "grid of the same method or to the indirect solution. NAME_slopes.csv has fitted "
                                     "orders, NAME_equal_accuracy.csv the sizes needed for equal accuracy. With the "
                                     "indirect solution (NAME_reference.csv), errors of stage values are measured too, "
                                     "and NAME_jumps.csv compares the largest jump of an interval with the true error.",
                      .options = {.intervals = "16:1024"},
                      .further_files = {"_slopes.csv", "_equal_accuracy.csv", "_reference.csv", "_jumps.csv"},
                      .polishes = true}) {}
  [[nodiscard]] Columns<Measured> columns() const override {
    constexpr auto error = &Measured::error;
    constexpr auto stages = &TrajectoryError::stages;
    const Columns<Measured> measured{
        {"state_error", "", "largest error of q over the nodes", from(error, &TrajectoryError::state)},
        {"control_error", "", "largest error of u over the stages", from(error, &TrajectoryError::control)},
        {"momentum_error", "", "largest error of p over the nodes", from(error, &TrajectoryError::momentum)},
        {"costate_error", "", "largest error of psi over the nodes", from(error, &TrajectoryError::costate)},
        {"objective_error", "cost", "error of the cost", from(error, &TrajectoryError::objective)},
        {"first_order_error", "", "largest error of first-order states over the nodes",
         from(error, &TrajectoryError::first_order)},
        {"first_order_costate_error", "", "largest error of the costate of first-order states over the nodes",
         from(error, &TrajectoryError::first_order_costate)},
        replay_error_column(&Measured::replay),
        {"control_from_costate_error", "",
         "largest error of the control recomputed from state and costate at the nodes",
         &Measured::control_from_costate_error},
        {"polish_steps", "", "number of Newton steps after the solve", &Measured::polish_steps},
        {"active", "", "quantities limited by active bounds or path constraints: control, state, or control and state",
         &Measured::active},
        {"stage_configuration_error", "", "largest error of Q_i", from(error, stages, &StageError::configuration)},
        {"stage_momentum_error", "", "largest error of P_i", from(error, stages, &StageError::momentum)},
        {"stage_costate_q_error", "", "largest error of Psi^q_i", from(error, stages, &StageError::costate_q)},
        {"stage_costate_p_error", "", "largest error of Psi^p_i", from(error, stages, &StageError::costate_p)},
    };
    return measured + columns_through<Measured>(&Measured::round_seconds, round_columns());
  }
  void add_options(CommandLine& line) override {
    line.option("--reference", reference_text_,
                "reference of the errors: N of a grid of the same method (default: the finest solved grid of each "
                "curve), or indirect, the solution of Pontryagin's boundary value problem, certified to 11 digits and "
                "kept in the output folder");
    line.flag("--polish,!--no-polish", card_.polishes,
              "refine solutions with Newton steps, so that errors are due to the method and not to the solver");
    line.option("--fit", fit_,
                "range a:b of N in which orders are fitted; default: the finest four or more grids above round-off "
                "between which the local order varies by at most 0.2");
  }

  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    reference_ = parse_reference(reference_text_);
    if (!fit_.empty()) {
      const std::size_t colon = fit_.find(':');
      if (colon == std::string::npos) throw Error("--fit takes a range of N, such as 16:128, not {}", fit_);
      const long long first = parse_intervals("--fit", fit_.substr(0, colon)).front();
      const long long last = parse_intervals("--fit", fit_.substr(colon + 1)).back();
      if (last < first) throw Error("--fit: the end of the range {} is below its start", fit_);
      std::set<long long> grids;
      for (const Case& the_case : chosen) grids.insert(intervals_of(the_case));
      const auto fitted = std::ranges::count_if(grids, [&](long long n) { return first <= n && n <= last; });
      if (fitted < fewest_in_range) {
        throw Error("--fit: {} of --intervals lie{} in the range {}; a fit needs at least {}", counted(fitted, "grid"),
                    fitted == 1 ? "s" : "", fit_, fewest_in_range);
      }
      fit_range_ = {first, last};
    }
    if (reference_ == exact_reference) {
      for (const Case& each : chosen) require_indirect(*each.problem);
      indirect_ = std::make_shared<IndirectReference>(card_.options.out);
    }
    if (reference_ > 0 && std::ranges::count(chosen, reference_, intervals_of) == 0) {
      throw Error("--reference {0} is not one of the grids; add {0} to --intervals", reference_);
    }
    std::vector<Case> cases;
    for (std::vector<Case>& curve : curves_of(chosen)) {
      for (Case& the_case : curve) the_case.shares = indirect_ ? the_case.problem->name() : label_of_curve(the_case);
      const auto found = std::ranges::find(curve, reference_, intervals_of);
      (found == curve.end() ? curve.back() : *found).is_reference = true;
      std::ranges::move(curve, std::back_inserter(cases));
    }
    return cases;
  }

  void measure(SolvedCase& solved, Measured& measured) override {
    const bool is_reference = solved.the_case.is_reference;
    if (is_reference) reference_trajectory_.reset();
    measured.polish_steps = solved.polish_steps;
    measured.round_seconds = seconds_of_rounds(solved);
    if (!solved.trajectory) return;
    measured.replay = replay(solved);
    // The error of an answer that is not a motion is drawn with open symbols, but excluded from fits and references.
    if (!is_discrete_optimum(solved)) return;
    const Problem& problem = *solved.the_case.problem;
    const Trajectory& trajectory = *solved.trajectory;
    const std::string active = active_bounds(problem, trajectory);
    if (active != "nothing") measured.active = active;
    if (indirect_) {
      reference_trajectory_ = indirect_->near(problem, trajectory).sampled_like(trajectory);
    } else if (is_reference || (reference_ == 0 && !reference_trajectory_)) {
      if (is_usable(solved)) reference_trajectory_ = trajectory;
      return;
    }
    if (!reference_trajectory_) return;
    measured.error = trajectory_error(trajectory, *reference_trajectory_);
    if (!measured.error->costate) return;
    measured.control_from_costate_error = node_control_error(problem, trajectory, *reference_trajectory_);
  }

  void finish(Table& table, FurtherOutput& output) override {
    nlohmann::ordered_json& metadata = output.metadata;
    FittedOrders orders = fit_orders(table, fit_range_, reference_);
    output.write("_slopes.csv", orders.table);
    output.write("_equal_accuracy.csv", equal_accuracy(table));
    metadata["reference"] = reference_ == exact_reference ? "the indirect solution"
                            : reference_ > 0              ? fmt::format("N = {} of the same method", reference_)
                                                          : "the finest solved grid of the same method";
    if (indirect_) {
      output.write("_reference.csv", indirect_->table());
      output.write("_jumps.csv", fit_jumps(table));
      metadata["references"] = indirect_->metadata();
      const std::vector<std::string> notes = indirect_->notes();
      orders.notes.insert(orders.notes.begin(), notes.begin(), notes.end());
    }
    output.summary.show("orders", orders_by_curve(orders.table), {}, output.prefix.string() + "_slopes.csv");
    for (const std::string& note : orders.notes) {
      metadata["notes"].push_back(note);
      output.summary.say("convergence: " + note);
    }
  }

 private:
  std::string reference_text_;
  long long reference_ = 0;  // N, 0 for the finest solved grid of each curve, or exact_reference
  std::string fit_;
  std::optional<FitRange> fit_range_;
  std::optional<Trajectory> reference_trajectory_;  // of the curve that is being measured
};

int run(int argc, char** argv) { return run_experiment(Convergence(), argc, argv); }

}  // namespace dmocbench::convergence_program
