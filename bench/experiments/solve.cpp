// One or more solutions, written out as motions: nodes, stages and the quantities of a picture.
#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiments/minor_trace.hpp"
#include "bench/experiments/wanted_accuracy.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/motion_files.hpp"
#include "methods/error.hpp"

namespace dmocbench::solve_program {

struct Measured {
  IndependentChecks checks;
  std::optional<double> estimated_error;
};

class Solve final : public ExperimentOf<Measured> {
 public:
  Solve()
      : ExperimentOf({.name = "solve",
                      .description =
                          "Solves and writes the motion: NAME_nodes.csv (t, q, v, p, psi), NAME_stages.csv (t, u) and "
                          "NAME_picture.csv; with several cases each NAME carries the case's label. Figures are drawn "
                          "of motions whose NAME is motion_PROBLEM.",
                      .options = {.intervals = "128", .start = "guess"},
                      .finishes_interrupted = true,
                      .wants_motions = true,
                      .takes_parts = false}) {}
  [[nodiscard]] Columns<Measured> columns() const override {
    return columns_through<Measured>(&Measured::checks, check_columns()) +
           Columns<Measured>{{"estimated_error", "",
                              "with --accuracy: relative error of q, p and cost, by an estimate that uses no reference",
                              &Measured::estimated_error}};
  }
  void add_options(CommandLine& line) override {
    trace_.add_to(line);
    line.flag("--costates,!--no-costates", takes_costates_,
              "--start FILE brings the file's costates as multipliers, for --solver interior_point and auto");
    accuracy_.add_to(line);
  }
  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    if (chosen.size() > 1) {
      const bool one_solver = std::ranges::count(chosen, chosen.front().solver, &Case::solver) == std::ssize(chosen);
      label_of_ = [one_solver](const Case& the_case) {
        return "_" + the_case.file_label() + (one_solver ? "" : "_" + the_case.solver);
      };
    }
    for (const Case& the_case : chosen) {
      for (const std::string& ending : endings_of_motion_files())
        card_.further_files.push_back(label_of_(the_case) + ending);
    }
    trace_.check(chosen, card_);
    accuracy_.check(chosen);
    if (accuracy_.is_wanted() && trace_.is_wanted())
      throw Error("--accuracy solves on several grids, --trace tells of one; leave one out");
    return chosen;
  }
  [[nodiscard]] SolvedCase solve(SolveTask task) override {
    task.takes_costates = takes_costates_;
    if (accuracy_.is_wanted()) return accuracy_.solve(std::move(task));
    return trace_.is_wanted() ? trace_.solve(task) : Experiment::solve(std::move(task));
  }
  void measure(SolvedCase& solved, Measured& measured) override {
    if (trace_.is_wanted()) trace_.write(solved);
    measured.estimated_error = solved.estimated_error;
    if (solved.solution.status != Status::solved) {
      failures_.push_back(
          fmt::format("{}: {}: {}", solved.the_case.label(), name_of(solved.solution.status), solved.solution.message));
    }
    if (!solved.trajectory) return;
    measured.checks = check_independently(solved);
    if (!is_solved(solved.solution.status) && !is_no_motion(solved.solution.status)) return;
    motions_.push_back(solved);
    motions_.back().program.reset();  // it is large
  }
  void finish(Table& /*table*/, FurtherOutput& output) override {
    for (const std::string& failure : failures_) print_line(fmt::format("solve: {}", failure));
    trace_.describe(output);
    for (const SolvedCase& solved : motions_) {
      if (!solved.trajectory || !solved.accuracy) continue;
      const std::string file = output.prefix.string() + label_of_(solved.the_case);
      write_motion(file, solved, output.metadata);
      if (solved.estimated_error) output.metadata["motions"].back()["estimated_error"] = *solved.estimated_error;
      print_line(fmt::format("solve: {}: {}_nodes.csv", solved.the_case.label(), file));
      print_line(fmt::format("solve: {}: intervals join to {:.1e} of the range, worst is interval {}",
                             solved.the_case.label(), solved.accuracy->relative_jump, solved.accuracy->interval));
      print_found(solved);
      print_excess(solved);
    }
  }

  /// What a solve chose besides the motion.
  static void print_found(const SolvedCase& solved) {
    const Problem& problem = *solved.the_case.problem;
    const Trajectory& motion = *solved.trajectory;
    const std::vector<std::size_t> unknowns = problem.unknowns();
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      const Parameter& parameter = problem.parameters()[unknowns[i]];
      print_line(fmt::format("solve: {}: {} = {:.10g}{}{}", solved.the_case.label(), parameter.name,
                             motion.unknowns[static_cast<Eigen::Index>(i)], parameter.unit.empty() ? "" : " ",
                             parameter.unit));
    }
    for (Eigen::Index i = 0; i < motion.integral_prices.size(); ++i) {
      print_line(fmt::format("solve: {}: integrands[{}]: the integral is {:.10g}, the price of its bound {:.6g}",
                             solved.the_case.label(), i, motion.integrals[i], motion.integral_prices[i]));
    }
  }

  /// The excess of a control is there wherever it switches, also where the motion misses little by it.
  static void print_excess(const SolvedCase& solved) {
    if (!is_solved(solved.solution.status) || !solved.between_stages ||
        solved.between_stages->control.constraint.empty())
      return;
    const MotionViolation& control = solved.between_stages->control;
    fmt::print(
        "solve: {}: {} is exceeded between stages by {:.2g} at t = {:.4g}; with clipped controls the motion misses "
        "{:.1e} of its range\n",
        solved.the_case.label(), control.constraint, control.size,
        solved.the_case.problem->card().time_unit.factor * control.time, solved.between_stages->missed);
  }

 private:
  MinorTrace trace_;
  WantedAccuracy accuracy_;
  bool takes_costates_ = true;
  /// What tells the motion of a case from those of the others, behind the table's name.
  std::function<std::string(const Case&)> label_of_ = [](const Case& /*the_case*/) { return ""; };
  std::vector<SolvedCase> motions_;    // solved, each with its trajectory
  std::vector<std::string> failures_;  // of the cases that were not solved in all respects, why, a sentence each
};

int run(int argc, char** argv) { return run_experiment(Solve(), argc, argv); }

}  // namespace dmocbench::solve_program
