// One or more solutions, written out as motions: nodes, stages and the quantities of a picture.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/experiment.hpp"
#include "bench/run/meanings.hpp"
#include "bench/run/motion_files.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/start_provider.hpp"
#include "methods/adaptive/adaptive_solve.hpp"
#include "methods/error.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/sqp/sqp_solver.hpp"
#include "methods/tables/motion_file.hpp"
#include "methods/transcription/start.hpp"

namespace dmocbench::solve_program {

/// A row per minor iteration. Columns of the quadratic program are named x3 (variable 3 of the program, from 0) or s5
/// (the slack of constraint 5).
Table trace_table(const std::vector<MinorIteration>& trace, Eigen::Index variables) {
  const auto named = [variables](const std::optional<Eigen::Index> MinorIteration::*column) {
    return [variables, column](const MinorIteration& minor) -> std::string {
      const std::optional<Eigen::Index>& index = minor.*column;
      if (!index) return {};
      return *index < variables ? fmt::format("x{}", *index) : fmt::format("s{}", *index - variables);
    };
  };
  const Columns<MinorIteration> columns{
      {"major", "", "major iteration", &MinorIteration::major},
      {"phase", "", "1 or 2", [](const MinorIteration& minor) { return static_cast<int>(minor.phase); }},
      {"entering", "", "column that enters", named(&MinorIteration::entering)},
      {"leaving", "", "column that leaves", named(&MinorIteration::leaving)},
      {"into_basis", "", "column that the basis takes up", named(&MinorIteration::into_basis)},
      {"step", "", "length of the step", &MinorIteration::step},
      {"infeasibility", "", "sum of infeasibilities", &MinorIteration::infeasibility},
      {"objective", "", "that of the quadratic program, scaled", &MinorIteration::objective},
      {"superbasics", "", "number of superbasic columns", &MinorIteration::superbasics},
      {"basic_slacks", "", "number of slacks in the basis", &MinorIteration::basic_slacks},
  };
  return table_of(columns, trace);
}

class Solve final : public Experiment {
 public:
  Solve()
      : Experiment({.name = "solve",
                    .description =
                        "Solves and writes the motion: NAME_nodes.csv (t, q, v, p, psi), NAME_stages.csv (t, u) and "
                        "NAME_picture.csv; with several cases each NAME carries the case's label. Figures are drawn of "
                        "motions whose NAME is motion_PROBLEM.",
                    .options = {.intervals = "128", .start = "guess"},
                    .takes_costates = true,
                    .finishes_interrupted = true,
                    .takes_parts = false}) {}
  [[nodiscard]] Columns<SolvedCase> columns() const override {
    return columns_of(checks_) +
           Columns<SolvedCase>{
               {"estimated_error", "",
                "with --accuracy: relative error of q, p and cost, by an estimate that uses no reference",
                of(estimated_error_)}};
  }
  void add_options(CommandLine& line) override {
    line.option(
        "--trace", trace_file_,
        "file for every minor iteration of one solve by sqp, a row each; the metadata tell of it if it is in the "
        "folder of --out");
    line.flag("--costates,!--no-costates", card_.takes_costates,
              "--start FILE brings the file's costates as multipliers, for --solver interior_point and auto");
    line.option(
        "--accuracy", accuracy_,
        "estimated relative error of q, p and cost at which to stop, 1e-14 to 0.1: refines one case grid by grid, "
        "beginning with --intervals or --grid");
    line.option("--refine", refine_, "with --accuracy: h (steps) or hp (steps, and up to three stages); default: h");
  }
  void check(const std::vector<Case>& cases) override {
    single_ = cases.size() == 1;
    if (!trace_file_.empty() && (!single_ || cases.front().solver != "sqp")) {
      throw Error("--trace needs exactly one case, solved by --solver sqp");
    }
    has_several_solvers_ =
        std::ranges::any_of(cases, [&](const Case& the_case) { return the_case.solver != cases.front().solver; });
    check_accuracy();
    for (const Case& the_case : cases) labels_.push_back(label_of(the_case));
    if (!trace_file_.empty()) check_trace();
  }
  void adapt(Case& the_case, Start& start, SolverOptions& options) override {
    if (accuracy_.empty()) return;
    const auto begin = Clock::now();
    const AdaptiveAnswer answer = adapted(the_case, start, options);
    const double spent = seconds_since(begin);
    const GridAttempt& last = answer.grids.back();
    if (answer.outcome != AdaptiveOutcome::reached) {
      const bool is_solved_there = is_solved(last.status);
      throw NoStart(answer.message, is_solved_there ? Status::not_confirmed : last.status);
    }
    the_case.grid = answer.program->grid();
    the_case.stages = static_cast<int>(last.stages);
    start.motion = smooth_motion(answer.trajectory);
    start.with_costates = answer.trajectory;
    estimated_error_ = answer.estimate.relative;
    constexpr double moment = 1e-9;
    if (options.most_seconds > 0.0) options.most_seconds = std::max(options.most_seconds - spent, moment);
    options.tolerance = adaptive_.solver_tolerance(options.tolerance);
  }
  [[nodiscard]] std::unique_ptr<Solver> solver_for(const Case& the_case, SolverOptions options) override {
    if (trace_file_.empty()) return Experiment::solver_for(the_case, options);
    SequentialOptions choices = sequential_options(named_options(this->options()));
    choices.on_minor_iteration = [this](const MinorIteration& minor) {
      if (!trace_.empty() && minor.major < trace_.back().major) trace_.clear();  // a repeated solve
      trace_.push_back(minor);
    };
    return std::make_unique<SqpSolver>(options, std::move(choices));
  }

  void complete(SolvedCase& solved) override {
    const auto variables = static_cast<Eigen::Index>(solved.program ? solved.program->variable_count() : 0);
    if (!trace_file_.empty()) {
      traced_ = trace_table(trace_, variables);
      write_file(trace_file_, traced_.csv());
    }
    checks_ = {};
    if (!is_solved(solved.solution.status)) {
      failures_.push_back(
          fmt::format("{}: {}: {}", solved.the_case.label(), name_of(solved.solution.status), solved.solution.message));
    }
    if (!solved.trajectory) return;
    checks_ = check_independently(solved);
    if (!is_solved(solved.solution.status)) return;
    motions_.push_back(solved);
    motions_.back().program.reset();  // it is large
  }

  [[nodiscard]] std::vector<std::string> further_files() const override {
    std::vector<std::string> files;
    for (const std::string& label : labels_) {
      for (const std::string& ending : endings_of_motion_files()) files.push_back(label + ending);
    }
    return files;
  }
  [[nodiscard]] std::vector<std::filesystem::path> named_files() const override {
    if (trace_file_.empty() || place_of(trace_file_).parent_path() != place_of(card_.options.out)) return {};
    return {trace_file_};
  }
  void finish(const Table& /*table*/, const std::filesystem::path& prefix, nlohmann::ordered_json& metadata) override {
    for (const std::string& failure : failures_) fmt::print("solve: {}\n", failure);
    for (const std::filesystem::path& file : named_files()) add_meanings(metadata, file, traced_);
    for (const SolvedCase& solved : motions_) {
      if (!solved.trajectory || !solved.accuracy) continue;
      const std::string file = prefix.string() + label_of(solved.the_case);
      write_motion(file, solved, metadata);
      if (estimated_error_) metadata["motions"].back()["estimated_error"] = *estimated_error_;
      fmt::print("solve: {}: {}_nodes.csv\n", solved.the_case.label(), file);
      fmt::print("solve: {}: intervals join to {:.1e} of the range, worst is interval {}\n", solved.the_case.label(),
                 solved.accuracy->relative_jump, solved.accuracy->interval);
    }
  }

 private:
  /// Throws `Error` if --accuracy and --refine do not fit each other or the cases.
  void check_accuracy() {
    if (accuracy_.empty()) {
      if (!refine_.empty()) throw Error("--refine says how --accuracy is reached; give --accuracy too");
      return;
    }
    if (!single_) throw Error("--accuracy refines exactly one case: one method, one number of stages, one first grid");
    if (!trace_file_.empty()) throw Error("--accuracy solves on several grids, --trace tells of one; leave one out");
    adaptive_.accuracy = parse_number("--accuracy", accuracy_);
    if (!refine_.empty()) adaptive_.refinement = refinement_named(refine_);
    try {
      adaptive_.validate();
    } catch (const Error& error) {
      throw Error(fmt::format("--accuracy: {}", error.what()));
    }
  }
  /// The answer by --accuracy; tells of every grid as soon as it is solved.
  [[nodiscard]] AdaptiveAnswer adapted(const Case& the_case, const Start& start, const SolverOptions& options) {
    adaptive_.solver = the_case.solver;
    adaptive_.solver_options = options;
    adaptive_.named_options = named_options(this->options());
    if (the_case.form != CostForm::bolza || the_case.derivatives != "tape") {
      throw Error("--accuracy refines with --form bolza and --derivatives tape");
    }
    const AdaptiveTask task{.problem = the_case.problem.get(),
                            .method = the_case.method,
                            .tableau = the_case.tableau,
                            .stages = the_case.stages,
                            .first = the_case.grid,
                            .start = start.motion};
    const Unit time = the_case.problem->card().time_unit;
    int number = 0;
    const auto tell = [&](const GridAttempt& grid) {
      if (number == 0) {
        fmt::print("solve: grid intervals stages estimated_error largest_step smallest_step{} iterations seconds\n",
                   time.name.empty() ? "" : " [" + time.name + "]");
      }
      fmt::print("solve: {:4} {:9} {:6} {:>15} {:12.4g} {:13.4g} {:10} {:.4f}\n", ++number, grid.intervals, grid.stages,
                 is_solved(grid.status) ? fmt::format("{:.2e}", grid.relative) : std::string(name_of(grid.status)),
                 time.factor * grid.largest_step, time.factor * grid.smallest_step, grid.iterations, grid.seconds);
    };
    const StopScope scope(options.stop_requested, options.most_seconds);
    try {
      AdaptiveAnswer answer = solve_adaptively(task, adaptive_, tell);
      fmt::print("solve: {}\n", answer.message);
      return answer;
    } catch (const Stopped&) {
      const bool interrupted = options.stop_requested && options.stop_requested();
      throw NoStart("The time was up between two grids.", interrupted ? Status::interrupted : Status::time_limit);
    }
  }

  /// What tells the motion of a case from those of the others, behind the table's name.
  [[nodiscard]] std::string label_of(const Case& the_case) const {
    if (single_) return "";
    return "_" + the_case.file_label() + (has_several_solvers_ ? "_" + the_case.solver : "");
  }

  /// Where a path leads, whether it is there or not.
  [[nodiscard]] static std::filesystem::path place_of(const std::filesystem::path& path) {
    std::error_code none;  // what is not there has no links to follow
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path), none);
  }

  /// Throws `Error` if the trace cannot be written, or would be lost under a file of the run.
  void check_trace() const {
    std::vector<std::string> own = further_files();
    own.insert(own.end(), {".csv", ".json"});
    for (const std::string& suffix : own) {
      if (place_of(trace_file_) != place_of(card_.options.out / (card_.options.name + suffix))) continue;
      throw Error(fmt::format("--trace {} is a file that the run itself writes; name another", trace_file_));
    }
    if (named_files().empty()) require_writable(trace_file_);
  }

  bool single_ = true;
  bool has_several_solvers_ = false;
  std::vector<std::string> labels_;  // of all cases
  std::string trace_file_;
  std::vector<MinorIteration> trace_;
  Table traced_;                       // the trace as it was written
  std::vector<SolvedCase> motions_;    // solved, each with its trajectory
  std::vector<std::string> failures_;  // of the cases that were not solved, why, a sentence each
  IndependentChecks checks_;           // of the case that is completed
  std::string accuracy_;               // empty: one grid
  std::string refine_;
  AdaptiveOptions adaptive_;
  std::optional<double> estimated_error_;
};

int run(int argc, char** argv) { return run_experiment(Solve(), argc, argv); }

}  // namespace dmocbench::solve_program
