// Errors over the step: fig:kepler_error and fig:twolink_error of the paper, and what accuracy costs.
#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiment/experiment.hpp"
#include "bench/experiment/indirect_reference.hpp"
#include "bench/experiment/interval_list.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/summary/equal_accuracy.hpp"
#include "bench/summary/fitted_orders.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/error.hpp"
#include "methods/indirect/node_control_error.hpp"

namespace dmocbench {

namespace {

/// What --reference says: N, 0 for the finest grid of each curve, or `exact_reference`.
long long parse_reference(const std::string& text) {
  if (text.empty()) return 0;
  if (text == "indirect") return exact_reference;
  long long intervals = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), intervals);
  if (failure != std::errc() || end != text.data() + text.size() || intervals <= 0) {
    throw Error(fmt::format("--reference must be a number of intervals or indirect, got {}", text));
  }
  return intervals;
}

class Convergence final : public Experiment {
 public:
  [[nodiscard]] std::string name() const override { return "convergence"; }
  [[nodiscard]] std::string description() const override {
    return "Errors of state, control, momentum, costate and cost against a fine grid of the same method or the "
           "indirect "
           "solution (NAME_reference.csv, where stage values have errors too), with fitted slopes (NAME_slopes.csv) "
           "and "
           "the cost of equal accuracy (NAME_equal_accuracy.csv).";
  }
  [[nodiscard]] std::string default_intervals() const override { return "16:1024"; }
  [[nodiscard]] std::vector<std::string> own_columns() const override {
    return {"state_error",
            "control_error",
            "momentum_error",
            "costate_error",
            "objective_error",
            "replay_error",
            "control_from_costate_error",
            "polish_steps",
            "stage_configuration_error",
            "stage_momentum_error",
            "stage_costate_q_error",
            "stage_costate_p_error"};
  }
  [[nodiscard]] bool polishes() const override { return polishes_; }
  void add_options(CommandLine& line) override {
    line.option("--reference", reference_text_,
                "what errors are measured against: N of a grid of the same method (default: the finest one of each "
                "curve), or indirect, the solution of Pontryagin's boundary value problem, certified to 11 digits and "
                "kept in the output folder");
    line.flag("--polish,!--no-polish", polishes_,
              "tighten answers by Newton steps, so that errors are those of the method and not of the solver");
    line.option(
        "--fit", fit_,
        "slopes are fitted from N = a to b, written a:b; default: 32 (64 with more than one stage) to a quarter of "
        "the reference, or to the finest grid against the indirect solution");
  }

  void check(const std::vector<Case>& cases) override {
    reference_ = parse_reference(reference_text_);
    if (!fit_.empty()) {
      const std::vector<long long> range = parse_intervals("--fit", fit_);
      fit_range_ = {range.front(), range.back()};
    }
    if (reference_ <= 0) return;
    const bool present = std::any_of(cases.begin(), cases.end(), [&](const Case& what) {
      return static_cast<long long>(what.intervals()) == reference_;
    });
    if (!present) throw Error(fmt::format("--reference {0}: add {0} to --intervals", reference_));
  }

  void prepare(const std::filesystem::path& folder) override {
    if (reference_ == exact_reference) indirect_.emplace(folder);
  }

  [[nodiscard]] std::vector<std::size_t> solving_order(const std::vector<Case>& curve) const override {
    std::vector<std::size_t> order{curve.size() - 1};
    for (std::size_t i = 0; i < curve.size(); ++i) {
      if (static_cast<long long>(curve[i].intervals()) == reference_) order[0] = i;
    }
    for (std::size_t i = 0; i < curve.size(); ++i) {
      if (i != order[0]) order.push_back(i);
    }
    return order;
  }

  void complete(SolvedCase& solved) override {
    const bool is_first = !curve_ || !curve_->same_curve(solved.what);
    if (is_first) {
      curve_ = solved.what;
      reference_trajectory_.reset();
    }
    if (!solved.trajectory) return;
    try {
      solved.row.set("replay_error", replay_error(*solved.what.problem, *solved.trajectory).norm());
    } catch (const Error& error) {
      solved.row.set("message", solved.row.text("message") + " " + error.what());
    }
    if (!is_usable(solved.row)) return;
    if (indirect_) {
      measure_against_indirect(*indirect_, *solved.what.problem, *solved.trajectory, solved.row);
    } else if (is_first) {
      reference_trajectory_ = *solved.trajectory;
    } else if (reference_trajectory_) {
      set_errors(*solved.what.problem, *solved.trajectory, *reference_trajectory_, solved.row);
    }
  }

  void finish(const Table& table, const std::filesystem::path& prefix, nlohmann::ordered_json& metadata) override {
    const FittedOrders slopes = fit_orders(table, fit_range_, reference_);
    write_file(prefix.string() + "_slopes.csv", slopes.table.csv());
    write_file(prefix.string() + "_equal_accuracy.csv", equal_accuracy(table).csv());
    if (indirect_) {
      write_file(prefix.string() + "_reference.csv", indirect_->table().csv());
      metadata["references"] = indirect_->metadata();
      for (const std::string& note : indirect_->notes()) tell(note, metadata);
    }
    for (const std::string& note : slopes.notes) tell(note, metadata);
  }

 private:
  static void tell(const std::string& note, nlohmann::ordered_json& metadata) {
    metadata["notes"].push_back(note);
    fmt::print("convergence: {}\n", note);
  }

  static void set_errors(const Problem& problem, const Trajectory& trajectory, const Trajectory& reference, Row& row) {
    const TrajectoryError error = trajectory_error(trajectory, reference);
    row.set("state_error", error.state);
    row.set("control_error", error.control);
    row.set("momentum_error", error.momentum);
    row.set("costate_error", error.costate);
    row.set("objective_error", error.objective);
    if (error.stages) {
      row.set("stage_configuration_error", error.stages->configuration);
      row.set("stage_momentum_error", error.stages->momentum);
      row.set("stage_costate_q_error", error.stages->costate_q);
      row.set("stage_costate_p_error", error.stages->costate_p);
    }
    if (!error.costate) return;
    try {
      row.set("control_from_costate_error", node_control_error(problem, trajectory, reference));
    } catch (const Error& failure) {
      row.set("message", row.text("message") + " " + failure.what());
    }
  }

  static void measure_against_indirect(IndirectReference& reference, const Problem& problem,
                                       const Trajectory& trajectory, Row& row) {
    try {
      set_errors(problem, trajectory, reference.near(problem, trajectory).sampled_like(trajectory), row);
    } catch (const Error& error) {
      row.set("message", row.text("message") + " " + error.what());
    }
  }

  bool polishes_ = true;
  std::string reference_text_;
  long long reference_ = 0;  // N, 0 for the finest grid of each curve, or exact_reference
  std::optional<IndirectReference> indirect_;
  std::string fit_;
  std::optional<FitRange> fit_range_;
  std::optional<Case> curve_;
  std::optional<Trajectory> reference_trajectory_;
};

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) {
  dmocbench::Convergence experiment;
  return dmocbench::run_experiment(experiment, argc, argv);
}
