#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/case_rows.hpp"
#include "bench/run/case_scheduler.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/described_tables.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/kept_rows.hpp"
#include "bench/run/metadata.hpp"
#include "bench/run/problem_libraries.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/run_plan.hpp"
#include "bench/run/run_summary.hpp"
#include "methods/mechanics/first_order_problem.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/tables/motion_file.hpp"

namespace dmocbench {

SolvedCase SolveTask::by(const Solver& solver) const {
  return solve_case(the_case, start, solver, options.tolerance, repeats, polishes);
}

void FurtherOutput::write(const std::string& suffix, const Table& table) {
  const std::filesystem::path file = prefix.string() + suffix;
  write_table(file, kept.joined(file, with_statements(table, kept.own())), metadata);
}

Experiment::Experiment(ExperimentCard card, Columns<SolvedCase> columns)
    : card_(std::move(card)), columns_(std::move(columns)) {
  card_.options.name = card_.name;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): overrides change the task
SolvedCase Experiment::solve(SolveTask task) {
  return task.by(*make_solver(task.the_case.solver, task.options, task.named_options));
}

OwnColumns Experiment::own_columns() {
  const auto solved = [](const MeasuredCase& one) -> const SolvedCase& { return one.solved; };
  return {.columns = columns_through<MeasuredCase>(solved, columns_)};
}

namespace {

/// The columns of an experiment's table.
Columns<MeasuredCase> columns_of(const ExperimentCard& card, const OwnColumns& own) {
  const auto solved = [](const MeasuredCase& one) -> const SolvedCase& { return one.solved; };
  const auto rounds = [](const MeasuredCase& one) { return seconds_of_rounds(one.solved); };
  Columns<MeasuredCase> columns = columns_through<MeasuredCase>(solved, core_columns()) + own.columns;
  std::ranges::find(columns, "tolerance", &Column<MeasuredCase>::name)->is_key = !card.options.tolerances.empty();
  return card.takes_turns ? columns + columns_through<MeasuredCase>(rounds, round_columns()) : columns;
}

/// One run of an experiment: its plan, its rows and its files.
class Run {
 public:
  Run(Experiment& experiment, RunSummary& summary, const std::vector<std::string>& command_line,
      const std::map<std::string, std::string>& options)
      : experiment_(experiment),
        summary_(summary),
        options_(experiment.options()),
        plan_(experiment),
        own_columns_(experiment.own_columns()),
        columns_(columns_of(experiment.card(), own_columns_)),
        metadata_(describe_run(command_line)),
        rows_(experiment, plan_.cases().size(), names_of(columns_), store_for(options)),
        scheduler_(experiment, plan_, columns_, own_columns_, rows_, summary.are_quiet()) {
    plan_.describe(metadata_);
  }

  int run() {
    listen_for_interrupt();
    if (plan_.part()) return run_part();
    const OutputFolder folder(options_.out);
    const ResultLock lock(plan_.prefix());
    read_kept_rows();
    if (options_.join.empty()) {
      resume();
      scheduler_.solve_all();
    } else {
      rows_.join(plan_, metadata_);
    }
    const bool complete = !interrupt_requested();
    Table own = rows_.table();
    if (own.rows().empty()) throw_if_interrupted();
    write(own, complete);
    complete ? rows_.remove_store() : rows_.sync();
    return report(own, complete);
  }

 private:
  [[nodiscard]] bool wants_motions() const { return experiment_.card().rows == RowUse::motions; }

  /// The rows of motions are not resumed, because a row is not the motion.
  [[nodiscard]] RowStore store_for(const std::map<std::string, std::string>& options) const {
    if (wants_motions()) return {};
    nlohmann::ordered_json header = header_of_store(plan_.identity(metadata_, options, names_of(columns_)), metadata_);
    if (const std::optional<Part>& part = plan_.part()) header["part"] = part->in_words();
    return {plan_.prefix().string() + ".rows", std::move(header)};
  }

  /// Takes over the rows of an interrupted run of the same identity.
  void resume() {
    if (wants_motions() || options_.fresh) return;
    const std::size_t resumed = rows_.resume(plan_.groups_of_rows());
    if (resumed == 0) return;
    for (std::size_t i = 0; i < plan_.cases().size(); ++i) {
      if (rows_.contain(i)) plan_.settle(i);
    }
    metadata_["resumed_rows"] = resumed;
    if (summary_.are_for_people() && plan_.wanted_count() > 0) {
      print_line(fmt::format("{}: resuming an interrupted run with {} of {} rows; use --fresh to solve all cases again",
                             experiment_.card().name, resumed, resumed + plan_.wanted_count()));
    }
  }

  /// Runs one part: its rows stay in its store.
  int run_part() {
    const std::filesystem::path& prefix = plan_.prefix();
    const std::string part = fmt::format("{}: part {}", experiment_.card().name, options_.part);
    const OutputFolder folder(prefix.parent_path(), true);
    const ResultLock lock(prefix);
    require_writable(prefix.string() + ".rows");
    const std::size_t rows = plan_.wanted_count();
    resume();
    const bool is_there = plan_.wanted_count() == 0 && rows > 0;
    scheduler_.solve_all();
    rows_.sync();
    const char* const end = is_there                ? " is already complete"
                            : interrupt_requested() ? " was interrupted; the same command resumes it"
                                                    : "";
    print_line(fmt::format("{}{}: {} of {} rows: {}.rows", part, end, rows - plan_.wanted_count(), plan_.cases().size(),
                           prefix.string()));
    return interrupt_requested() ? 130 : 0;
  }

  /// Prints how the run ended; returns the exit code.
  [[nodiscard]] int report(const Table& own, bool complete) const {
    const Outcome outcome = outcome_of(own);
    const bool lacks_motion = outcome.failures + outcome.too_coarse + outcome.violating > 0;
    const bool has_failed = wants_motions() ? lacks_motion : outcome.unusable_curves > 0;
    const int code = !complete ? 130 : has_failed ? 1 : 0;
    if (summary_.are_for_people()) print_end(outcome, own, complete);
    nlohmann::ordered_json end{{"experiment", experiment_.card().name},
                               {"exit_code", code},
                               {"complete", complete},
                               {"rows", own.rows().size()},
                               {"file", table_file().string()}};
    describe(outcome, end);
    summary_.end(end);
    return code;
  }

  void print_end(const Outcome& outcome, const Table& own, bool complete) const {
    const std::string& name = experiment_.card().name;
    const std::size_t kept = kept_.count(table_file());
    const std::string all = counted(plan_.cases().size(), "row was", "rows were");
    print_line(fmt::format(
        "{}: {}{}, {} not solved{}{}: {}{}", name, complete ? "" : fmt::format("interrupted before {} complete: ", all),
        counted(own.rows().size(), "row"), outcome.failures,
        outcome.other_branch == 0 ? "" : fmt::format(", {} on a different branch from the start", outcome.other_branch),
        outcome.no_motions_by_method, table_file().string(),
        kept == 0 ? "" : fmt::format(" (and {} of other problems or settings)", counted(kept, "earlier row"))));
    if (!complete && !wants_motions()) print_line(name + ": the same command resumes it");
    // Its message says what happened and what to try; other messages are in the rows.
    if (!outcome.first_failure.empty()) print_line(name + ": " + outcome.first_failure);
  }

  /// The files of the run: its table, the files of the experiment, and `further` ones.
  [[nodiscard]] std::vector<std::filesystem::path> files_of_run(std::vector<std::filesystem::path> further) const {
    further.insert(further.begin(), table_file());
    for (const std::string& suffix : experiment_.card().further_files)
      further.emplace_back(plan_.prefix().string() + suffix);
    return further;
  }

  [[nodiscard]] std::filesystem::path table_file() const { return plan_.prefix().string() + ".csv"; }

  /// Reads the rows of earlier runs that stay in the tables of this one.
  void read_kept_rows() {
    kept_ = KeptRows(plan_.prefix(), plan_.cases());
    kept_.require_columns(table_file(), names_of(columns_));
    for (const std::filesystem::path& file : files_of_run({})) {
      require_writable(file);
      kept_.require_no_other_motion(file);
      if (file.extension() == ".csv") kept_.read(file);
    }
    kept_.describe_runs(metadata_);
  }

  /// Of problems that are solved by several methods although all have the same solution.
  void say_where_methods_coincide() const {
    std::map<std::string, std::set<std::string>> methods;
    for (const Case& one : plan_.cases()) {
      if (has_no_configuration(*one.problem)) methods[one.problem->name()].insert(one.method);
    }
    for (const auto& [problem, all] : methods) {
      if (all.size() == 1) continue;
      summary_.say(problem + " has only first-order states: all methods coincide, so there is nothing to compare");
    }
  }

  /// Writes the files of the run, in the order in which old and new ones are never mixed: first the metadata call the
  /// run incomplete.
  void write(Table& own, bool complete) {
    replace_earlier_files();
    FurtherOutput output{.prefix = plan_.prefix(), .metadata = metadata_, .kept = kept_, .summary = summary_};
    if (complete || wants_motions()) experiment_.finish(own, output);
    say_where_methods_coincide();
    const Table table = kept_.joined(table_file(), own);
    if (!own.rows().empty()) write_file(table_file(), table.csv());
    metadata_["cases"] = plan_.cases().size() + kept_.count(table_file());
    metadata_["rows"] = table.rows().size();
    describe(outcome_of(table), metadata_);
    const std::vector<std::filesystem::path> files = files_of_run(output.named_by_user);
    describe_tables_of_run(files, table_of(columns_, {}), metadata_);
    write_metadata_of(files, complete, metadata_);
  }

  void write_metadata_of(const std::vector<std::filesystem::path>& files, bool complete,
                         nlohmann::ordered_json metadata) const {
    kept_.describe_end(complete, metadata);
    kept_.describe_files(files, metadata);
    write_metadata(plan_.prefix().string() + ".json", metadata);
  }

  /// The files of an earlier run make room for this one's, except for rows that stay. One that the run starts from is
  /// kept.
  void replace_earlier_files() const {
    write_metadata_of(files_of_run({}), false, metadata_);
    for (const std::string& suffix : experiment_.card().further_files) {
      const std::string file = plan_.prefix().string() + suffix;
      if (!is_file_of_motion(file, options_.start)) kept_.reduce(file);
    }
  }

  Experiment& experiment_;
  RunSummary& summary_;
  const ExperimentOptions& options_;
  RunPlan plan_;
  OwnColumns own_columns_;
  Columns<MeasuredCase> columns_;
  nlohmann::ordered_json metadata_;
  CaseRows rows_;
  CaseScheduler scheduler_;
  KeptRows kept_;
};

}  // namespace

int run_experiment(Experiment&& experiment, int argc, char** argv) {
  const ExperimentCard& card = experiment.card();
  return run_program(card.name, card.description, argc, argv, [&](CommandLine& line) {
    line.footer(fmt::format("Columns of {}.csv:\n{}", card.name, describe(columns_of(card, experiment.own_columns()))));
    line.example(!card.example.empty() ? card.example
                                       : fmt::format("--problem {} --intervals {}", card.options.problems.front(),
                                                     card.options.intervals));
    const bool wants_motions = card.rows == RowUse::motions;
    line.exit_code_1(wants_motions ? "a case is not solved, or its grid is too coarse"
                                   : "a curve has no usable row (the rows state the reasons)");
    add_options(line, experiment.options());
    line.ignored_unless(
        "--start-seconds",
        [&card] {
          const std::string& start = card.options.start;
          return start == "common" || (start == "guess" && card.branches == BranchReport::of_any_start);
        },
        "only --start common needs a search");
    RunSummary summary;
    summary.add_to(line);
    line.group("Work");
    if (card.problems_are_independent) add_jobs_option(line, experiment.options());
    if (card.compares_tolerances) add_tolerances_option(line, experiment.options());
    if (card.takes_batches) add_batch_option(line, experiment.options());
    line.group("Options of this experiment");
    experiment.add_options(line);
    if (!wants_motions) add_part_options(line, experiment.options());
    const std::vector<std::string> command_line = parse_with_libraries(line);
    return Run(experiment, summary, command_line, line.values_for_results()).run();
  });
}

}  // namespace dmocbench
