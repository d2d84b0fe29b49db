// One or more solutions, written out as motions: nodes, stages and the quantities of a picture.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiment/experiment.hpp"
#include "bench/experiment/meanings.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/experiment/start_provider.hpp"
#include "methods/adaptive/adaptive_solve.hpp"
#include "methods/error.hpp"
#include "methods/interchange/ampl_answer.hpp"
#include "methods/interchange/ampl_model.hpp"
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
    line.option("--write-nl", nl_file_,
                "FILE.nl for solvers that read AMPL's format: the program of one case and its start, with the names of "
                "rows and unknowns in FILE.row and FILE.col; written before the case is solved");
    line.option(
        "--read-sol", sol_file_,
        "FILE.sol, the answer of such a solver: it takes the place of the solve, so that --solver and --start have "
        "no part in it, and is judged as every answer. It is known by its sizes alone");
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
    check_interchange(cases);
    for (const Case& the_case : cases) labels_.push_back(label_of(the_case));
    if (!trace_file_.empty()) check_trace();
  }
  void adapt(Case& the_case, Start& start, SolverOptions& options) override {
    write_nl(the_case, start);
    if (answer_) the_case.solver = "ampl";
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
    if (answer_) return std::make_unique<AmplAnswer>(*answer_, options);
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
    if (answer_ && !answer_->message.empty()) solved.note(fmt::format("Its solver says: {}", answer_->message));
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
      for (const char* const ending : {"_stages.csv", "_picture.csv", "_nodes.csv"}) files.push_back(label + ending);
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
      const Case& the_case = solved.the_case;
      const Trajectory& motion = *solved.trajectory;
      const std::string file = prefix.string() + label_of(the_case);
      write_table(file + "_stages.csv", stage_table(*the_case.problem, motion), metadata);
      write_table(file + "_picture.csv", picture_table(*the_case.problem, motion), metadata);
      write_table(file + "_nodes.csv", node_table(*the_case.problem, motion), metadata);
      metadata["motions"].push_back({{"nodes", std::filesystem::path(file + "_nodes.csv").filename().string()},
                                     {"problem", the_case.problem->name()},
                                     {"settings", the_case.problem->settings()},
                                     {"method", the_case.method},
                                     {"tableau", the_case.tableau},
                                     {"stages", the_case.stages},
                                     {"solver", the_case.solver},
                                     {"answered_by", solved.solution.solver},
                                     {"intervals", the_case.intervals()},
                                     {"costates_are_estimated", solved.solution.multipliers_are_estimated}});
      if (estimated_error_) metadata["motions"].back()["estimated_error"] = *estimated_error_;
      fmt::print("solve: {}: {}_nodes.csv\n", the_case.label(), file);
      fmt::print("solve: {}: intervals join to {:.1e} of the range, worst is interval {}\n", the_case.label(),
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
  /// Throws `Error` if --write-nl or --read-sol do not fit the cases, or their files are not what they should be.
  void check_interchange(const std::vector<Case>& cases) {
    if (nl_file_.empty() && sol_file_.empty()) return;
    const char* const option = nl_file_.empty() ? "--read-sol" : "--write-nl";
    if (!single_)
      throw Error(fmt::format("{} is for exactly one case: one method, one number of stages, one grid", option));
    if (!accuracy_.empty())
      throw Error(fmt::format("--accuracy solves on several grids, {} knows one; leave one out", option));
    if (!sol_file_.empty() && !trace_file_.empty()) throw Error("--read-sol solves nothing that --trace could tell of");
    const Case& the_case = cases.front();
    if (the_case.method.starts_with("single_shooting")) {
      throw Error(
          fmt::format("{}: what single_shooting simulates cannot be written as formulas of its unknowns; "
                      "multiple_shooting is the same program with the nodes as unknowns",
                      option));
    }
    if (!nl_file_.empty()) check_nl();
    if (sol_file_.empty()) return;
    try {
      answer_ = read_ampl_solution(read_file(sol_file_));
      AmplAnswer(*answer_).require_fit(*the_case.transcribe());
    } catch (const Error& error) {
      const std::string reason = error.what();
      if (reason.find(sol_file_) != std::string::npos) throw;
      throw Error(fmt::format("--read-sol {}: {}", sol_file_, reason));
    }
  }
  /// FILE.nl, then the names beside it.
  [[nodiscard]] std::vector<std::filesystem::path> files_of_nl() const {
    const std::filesystem::path file(nl_file_);
    std::vector<std::filesystem::path> files{file};
    for (const char* const ending : {".row", ".col"})
      files.push_back(std::filesystem::path(file).replace_extension(ending));
    return files;
  }
  void check_nl() const {
    if (std::filesystem::path(nl_file_).extension() != ".nl") {
      throw Error(fmt::format("--write-nl {}: the name has to end in .nl", nl_file_));
    }
    for (const std::filesystem::path& file : files_of_nl()) {
      std::error_code none;
      if (std::filesystem::exists(std::filesystem::symlink_status(file, none))) {
        throw Error(fmt::format("--write-nl: {} exists already; remove it or name another file", file.string()));
      }
      require_writable(file);
    }
  }
  void write_nl(const Case& the_case, const Start& start) const {
    if (nl_file_.empty()) return;
    const auto program = the_case.transcribe();
    const AmplModel model = ampl_model(*program, sample(*program, start.motion));
    const std::vector<std::filesystem::path> files = files_of_nl();
    write_file(files[1], model.row);
    write_file(files[2], model.col);
    write_file(files[0], model.nl);
    fmt::print("solve: {}: {} variables, {} constraints: {}\n", the_case.label(), program->variable_count(),
               program->constraint_count(), nl_file_);
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
  std::string nl_file_;
  std::string sol_file_;
  std::optional<AmplSolution> answer_;  // of --read-sol
  std::string accuracy_;                // empty: one grid
  std::string refine_;
  AdaptiveOptions adaptive_;
  std::optional<double> estimated_error_;
};

int run(int argc, char** argv) { return run_experiment(Solve(), argc, argv); }

}  // namespace dmocbench::solve_program
