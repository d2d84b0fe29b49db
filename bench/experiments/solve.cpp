// One or more solutions, written out as motions: nodes, stages and the quantities of a picture.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiments/solve/minor_trace.hpp"
#include "bench/experiments/solve/wanted_accuracy.hpp"
#include "bench/run/advice.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/motion_files.hpp"
#include "methods/error.hpp"

namespace dmocbench::solve_program {

struct Measured {
  IndependentChecks checks;
  std::optional<double> estimated_error;
};

std::vector<std::string> answer_columns(bool with_horizon, bool with_estimate) {
  std::vector<std::string> columns{"problem", "method", "N", "status", "cost"};
  if (with_horizon) columns.emplace_back("T");
  if (with_estimate) columns.emplace_back("estimated error");
  for (const char* const column : {"iterations", "seconds", "replay error", "worst between stages", "files"})
    columns.emplace_back(column);
  return columns;
}

/// "path_constraints[0] (height) by 2e-03 at t = 0.4", the constraint that is left farthest relative to its scale.
std::string violation_in_words(const SolvedCase& solved) {
  if (!solved.between_stages) return "not checked";
  const ViolationBetweenStages& found = *solved.between_stages;
  const MotionViolation& worst = found.state.share >= found.control.share ? found.state : found.control;
  if (worst.constraint.empty()) return "none";
  return fmt::format("{} by {:.1e} at t = {:.4g}", worst.constraint, worst.size,
                     solved.the_case.problem->card().time_unit.factor * worst.time);
}

Row row_of_answer(const SolvedCase& solved, const IndependentChecks& checks, const std::string& files) {
  const Solution& solution = solved.solution;
  const Problem& problem = *solved.the_case.problem;
  const Unit time = problem.card().time_unit;
  Row row;
  row.set("problem", problem.name());
  row.set("method", solved.the_case.method);
  row.set("tableau", solved.the_case.tableau);
  row.set("stages", solved.the_case.stages);
  row.set("solver", solved.the_case.solver);
  row.set("derivatives", solved.the_case.derivatives);
  row.set("N", solved.the_case.intervals());
  row.set("status", name_of(solution.status));
  row.set("iterations", solution.major_iterations);
  row.set("seconds", fmt::format("{:.2g}", solution.seconds));
  if (solved.trajectory) {
    row.set("cost", solved.trajectory->cost);
    row.set("T", fmt::format("{:.6g}{}{}", time.factor * solved.trajectory->node_times.tail<1>()[0],
                             time.name.empty() ? "" : " ", time.name));
  }
  if (solved.estimated_error) row.set("estimated error", fmt::format("{:.1e}", *solved.estimated_error));
  row.set("replay error", checks.replay ? replay_in_words(problem, *checks.replay) : "none");
  row.set("worst between stages", violation_in_words(solved));
  row.set("files", files);
  return row;
}

class Solve final : public ExperimentOf<Measured> {
 public:
  Solve()
      : ExperimentOf(
            {.name = "solve",
             .description =
                 "Solves a problem and writes the trajectory: NAME_nodes.csv (t, q, v, p, psi), NAME_stages.csv (t, u) "
                 "and NAME_picture.csv. NAME is the value of --name, by default solve_ followed by the problem and its "
                 "settings. With several cases, the label of the case is appended to NAME. After a failed solve, the "
                 "last iterate is written; --start NAME_nodes.csv continues from this iterate.",
             .options = {.solvers = {"auto"}, .intervals = "128", .start = "guess"},
             .rows = RowUse::motions,
             .example = "--problem two_link_manipulator --method dmoc --intervals 64"}) {}
  [[nodiscard]] Columns<Measured> columns() const override {
    return columns_through<Measured>(&Measured::checks, check_columns()) +
           Columns<Measured>{{"estimated_error", "",
                              "relative error of q, p and cost, estimated without a reference (only with --accuracy)",
                              &Measured::estimated_error}};
  }
  void add_options(CommandLine& line) override {
    trace_.add_to(line);
    line.flag("--costates,!--no-costates", takes_costates_,
              "use the costates of --start FILE as initial multipliers (only with --solver interior_point or auto)");
    line.ignored_unless(
        "--costates",
        [this] {
          const auto uses = [](const std::string& solver) { return solver == "interior_point" || solver == "auto"; };
          const bool is_file = options().start != "common" && options().start != "guess";
          return is_file && std::ranges::any_of(options().solvers, uses);
        },
        "only interior_point and auto use the costates of --start FILE");
    accuracy_.add_to(line);
  }
  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    if (chosen.size() > 1) {
      const bool one_solver = std::ranges::count(chosen, chosen.front().solver, &Case::solver) == std::ssize(chosen);
      label_of_ = [one_solver](const Case& the_case) {
        return "_" + the_case.file_label() + (one_solver ? "" : "_" + the_case.solver);
      };
    } else if (options().name == card().name) {  // other problems have their motions next to it
      label_of_ = [](const Case& the_case) { return "_" + the_case.file_label_of_problem(); };
    }
    for (const Case& the_case : chosen) {
      for (const std::string& ending : endings_of_motion_files())
        card_.further_files.push_back(label_of_(the_case) + ending);
    }
    trace_.check(chosen, card_);
    accuracy_.check(chosen);
    if (accuracy_.is_wanted() && trace_.is_wanted())
      throw Error("--accuracy solves on several grids, but --trace records a single solve; leave one out");
    return chosen;
  }
  [[nodiscard]] SolvedCase solve(SolveTask task) override {
    if (!takes_costates_) task.start.with_costates.reset();
    if (accuracy_.is_wanted()) return accuracy_.solve(std::move(task));
    return trace_.is_wanted() ? trace_.solve(task) : Experiment::solve(std::move(task));
  }
  void measure(SolvedCase& solved, Measured& measured) override {
    if (trace_.is_wanted()) trace_.write(solved);
    measured.estimated_error = solved.estimated_error;
    if (solved.trajectory) measured.checks = check_independently(solved);
    answers_.push_back({solved, measured.checks});
    answers_.back().solved.program.reset();  // it is large
  }
  void finish(Table& /*table*/, FurtherOutput& output) override {
    trace_.describe(output);
    Table summary(answer_columns(std::ranges::any_of(answers_, has_free_horizon), accuracy_.is_wanted()));
    summary.set_key({"problem", "method", "tableau", "stages", "solver", "derivatives", "N"});
    for (const auto& [solved, checks] : answers_) {
      const std::string file = output.prefix.string() + label_of_(solved.the_case);
      summary.append(row_of_answer(solved, checks, solved.trajectory ? file + "_nodes.csv" : "none"));
      if (!solved.trajectory) continue;
      write_motion(file, solved, output.metadata);
      if (solved.estimated_error) output.metadata["motions"].back()["estimated_error"] = *solved.estimated_error;
    }
    if (accuracy_.is_wanted()) output.summary.show("grids", accuracy_.grids(), {}, "", accuracy_.grids().rows().size());
    output.summary.show("answers", summary, {}, output.prefix.string() + ".csv");
    std::set<std::string> doubts;
    for (const Answer& answer : answers_) {
      const Status status = answer.solved.solution.status;
      if (is_solved(status) || is_no_motion(status))
        doubts.insert(in_words(doubt_about_units(*answer.solved.the_case.problem)));
    }
    for (const std::string& doubt : doubts) {
      if (!doubt.empty()) output.summary.say(doubt);
    }
    for (const Answer& answer : answers_) {
      const Solution& solution = answer.solved.solution;
      if (solution.status != Status::solved) {
        output.summary.say(
            fmt::format("{}: {}: {}", answer.solved.the_case.label(), name_of(solution.status), solution.message));
      }
      const std::string doubt = in_words(doubt_about_replay(answer.solved, answer.checks.replay));
      if (!doubt.empty()) output.summary.say(fmt::format("{}: {}", answer.solved.the_case.label(), doubt));
      // After a failure the last point is no optimum, whose bounds would have prices.
      const bool is_optimum = is_solved(solution.status) || is_no_motion(solution.status);
      if (answer.solved.trajectory && is_optimum) say_found(answer.solved, output.summary);
    }
  }

  /// Reports the values that a solve found besides the motion.
  static void say_found(const SolvedCase& solved, RunSummary& summary) {
    const Problem& problem = *solved.the_case.problem;
    const Trajectory& motion = *solved.trajectory;
    const std::string label = solved.the_case.label();
    const auto say_price = [&](const std::string& value, const char* limits, double price) {
      summary.say(fmt::format("{}: {}; the multiplier of its {} is {:.6g}", label, value, limits, price));
    };
    // Solvers leave less than this share of the cost where no bound acts.
    const auto acts = [&](double price, double value) {
      return std::abs(price * value) > 1e-6 * std::abs(motion.cost);
    };
    const std::vector<std::size_t> unknowns = problem.unknowns();
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      const Parameter& parameter = problem.parameters()[unknowns[i]];
      const auto entry = static_cast<Eigen::Index>(i);
      const double value = motion.unknowns[entry];
      const double price = motion.has_costates() ? motion.prices.unknowns[entry] : 0.0;
      const std::string found =
          fmt::format("{} = {:.10g}{}{}", parameter.name, value, parameter.unit.empty() ? "" : " ", parameter.unit);
      if (acts(price, value)) {
        say_price(found, "range", price);
      } else {
        summary.say(fmt::format("{}: {}", label, found));
      }
    }
    const double horizon = motion.node_times[motion.intervals()];
    if (acts(motion.prices.horizon, horizon)) {
      say_price(fmt::format("T = {:.10g}", horizon), "bounds", motion.prices.horizon);
    }
    for (Eigen::Index i = 0; i < motion.integral_prices.size(); ++i) {
      say_price(fmt::format("integrands[{}]: the integral is {:.10g}", i, motion.integrals[i]), "bounds",
                motion.integral_prices[i]);
    }
  }

 private:
  MinorTrace trace_;
  WantedAccuracy accuracy_;
  bool takes_costates_ = true;
  /// The ending after the table's name that distinguishes the motion of a case from the others.
  std::function<std::string(const Case&)> label_of_ = [](const Case& /*the_case*/) { return ""; };
  struct Answer {
    SolvedCase solved;
    IndependentChecks checks;
  };
  [[nodiscard]] static bool has_free_horizon(const Answer& answer) {
    return answer.solved.the_case.problem->bounds().horizon.is_free();
  }
  std::vector<Answer> answers_;
};

int run(int argc, char** argv) { return run_experiment(Solve(), argc, argv); }

}  // namespace dmocbench::solve_program
