#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/advice.hpp"
#include "bench/run/case_batch.hpp"
#include "bench/run/case_list.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/kept_rows.hpp"
#include "bench/run/meanings.hpp"
#include "bench/run/metadata.hpp"
#include "bench/run/outcome.hpp"
#include "bench/run/parts_of_run.hpp"
#include "bench/run/problem_libraries.hpp"
#include "bench/run/process_pool.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/start_provider.hpp"
#include "methods/error.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/counted.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/tables/motion_file.hpp"
#include "methods/tables/table_file.hpp"

namespace dmocbench {

namespace {

/// Each once for every tolerance that is compared. Throws `Error` on anything unknown or out of range.
std::vector<Case> cases_of(Experiment& experiment) {
  const std::vector<Case> cases = experiment.cases(expand_cases(experiment.options()));
  return with_tolerances(cases, chosen_tolerances(experiment.options()));
}

/// The columns of its table.
Columns<MeasuredCase> columns_of(const ExperimentCard& card, const OwnColumns& own) {
  const auto solved = [](const MeasuredCase& one) -> const SolvedCase& { return one.solved; };
  const auto rounds = [](const MeasuredCase& one) { return seconds_of_rounds(one.solved); };
  Columns<MeasuredCase> columns = columns_through<MeasuredCase>(solved, core_columns()) + own.columns;
  std::ranges::find(columns, "tolerance", &Column<MeasuredCase>::name)->is_key = !card.options.tolerances.empty();
  return card.takes_turns ? columns + columns_through<MeasuredCase>(rounds, round_columns()) : columns;
}

/// The problems that a run is about. Instances count as the problem whose values they vary.
std::set<Statement> statements_of(const std::vector<Case>& cases) {
  std::set<Statement> statements;
  for (const Case& one : cases) statements.insert(statement_of(one.nominal ? *one.nominal : *one.problem));
  return statements;
}

bool has_instances(const std::vector<Case>& cases) {
  return std::ranges::any_of(cases, [](const Case& one) { return one.nominal != nullptr; });
}

/// One run of an experiment: its cases, its table, its files.
class Run {
 public:
  Run(Experiment& experiment, Findings& findings, const std::vector<std::string>& command_line,
      const std::map<std::string, std::string>& values)
      : experiment_(experiment),
        findings_(findings),
        options_(experiment.options()),
        solver_options_(solver_options(options_)),
        cases_(cases_of(experiment)),
        starts_({.start = options_.start,
                 .most_seconds = options_.start_seconds,
                 .reports_branch = experiment.card().branches != BranchReport::none,
                 .takes_costates = experiment.card().rows == RowUse::motions,
                 .reports_branch_from_guess = experiment.card().branches == BranchReport::of_any_start},
                solver_options_),
        own_columns_(experiment.own_columns()),
        columns_(columns_of(experiment.card(), own_columns_)),
        names_(names_of(columns_)),
        rows_(cases_.size()),
        metadata_(describe_run(command_line)),
        parts_(experiment, cases_, metadata_, values, names_),
        prefix_(parts_.is_one() ? parts_.file() : options_.out / options_.name),
        progress_(experiment.card().name, findings.are_quiet()) {
    starts_.check(cases_);
    is_own_ = parts_.own_cases();
    shown_cases_ = static_cast<std::size_t>(own_cases());
    starts_.on_progress = [this](const std::string& activity) { show(activity); };
    starts_.on_long_search = [this](const std::string& sentence) {
      if (!progress_.is_shown() && !findings_.are_quiet())
        fmt::print(stderr, "{}: {}\n", experiment_.card().name, sentence);
    };
    metadata_["start"] = options_.start;
    if (options_.tolerances.empty()) metadata_["tolerance"] = options_.tolerance;
    metadata_["repeats"] = options_.repeats;
    for (const Case& the_case : cases_) {
      nlohmann::ordered_json& scale = metadata_["cost_scale"][the_case.problem->name()];
      if (scale.is_null()) scale = the_case.problem->cost_scale();
      const ProblemCard card = the_case.problem->card();
      if (card.configuration_units.empty() && card.control_units.empty()) continue;
      metadata_["units"][the_case.problem->name()] = {{"configurations", card.configuration_units},
                                                      {"controls", card.control_units}};
    }
    const NamedOptions named = named_options(options_);
    for (const std::string& solver : options_.solvers) static_cast<void>(make_solver(solver, solver_options_, named));
  }

  int run() {
    listen_for_interrupt();
    if (!options_.missing_parts.empty()) return name_missing_parts();
    if (parts_.is_one()) return run_part();
    const OutputFolder folder(options_.out);
    const ResultLock lock(prefix_);
    read_kept_rows();
    if (options_.join.empty()) {
      resume();
      solve_all();
    } else {
      rows_ = parts_.join(metadata_);
      replace_earlier_files();
    }
    const bool complete = !interrupt_requested();
    Table own = own_rows();
    if (own.rows().empty()) throw_if_interrupted();
    FurtherOutput output{.prefix = prefix_, .metadata = metadata_, .kept = kept_, .findings = findings_};
    if (complete || wants_motions()) experiment_.finish(own, output);
    const Table table = kept_.joined(table_file(), own);
    if (!own.rows().empty()) write_file(table_file(), table.csv());
    kept_.describe_end(complete, metadata_);
    metadata_["cases"] = cases_.size() + kept_.count(table_file());
    metadata_["rows"] = table.rows().size();
    describe(outcome_of(table), metadata_);
    const std::vector<std::filesystem::path> files = files_of_run(output.named_by_user);
    describe_tables_of_run(files, table_of(columns_, {}), metadata_);
    kept_.describe_files(names_of_files(files), metadata_);
    write_metadata(prefix_.string() + ".json", metadata_);
    end_unfinished(complete);
    return report(own, complete);
  }

 private:
  [[nodiscard]] bool wants_motions() const { return experiment_.card().rows == RowUse::motions; }

  /// Prints how the run ended; returns the exit code.
  [[nodiscard]] int report(const Table& own, bool complete) const {
    const Outcome outcome = outcome_of(own);
    const bool lacks_motion = outcome.failures + outcome.too_coarse + outcome.violating > 0;
    const bool has_failed = wants_motions() ? lacks_motion : outcome.unusable_curves > 0;
    const int code = !complete ? 130 : has_failed ? 1 : 0;
    if (findings_.are_for_people()) print_end(outcome, own, complete);
    nlohmann::ordered_json end{{"experiment", experiment_.card().name},
                               {"exit_code", code},
                               {"complete", complete},
                               {"rows", own.rows().size()}};
    describe(outcome, end);
    end["file"] = table_file().string();
    findings_.end(end);
    return code;
  }

  void print_end(const Outcome& outcome, const Table& own, bool complete) const {
    const std::string& name = experiment_.card().name;
    const std::size_t kept = kept_.count(table_file());
    print_line(fmt::format(
        "{}: {}{}, {} not solved{}{}: {}{}", name,
        complete ? "" : fmt::format("interrupted before {} complete: ", counted(cases_.size(), "row was", "rows were")),
        counted(own.rows().size(), "row"), outcome.failures,
        outcome.other_branch == 0 ? "" : fmt::format(", {} on another branch than the start", outcome.other_branch),
        outcome.no_motions_by_method, table_file().string(),
        kept == 0 ? "" : fmt::format(" (and {} of other problems or settings)", counted(kept, "earlier row"))));
    if (!complete && !wants_motions()) print_line(name + ": the same command resumes it");
    // The message of the first one says what happened and what to try; the others stand in their rows.
    const auto failed = std::ranges::find_if(own.rows(), is_failure);
    if (failed == own.rows().end()) return;
    print_line(fmt::format("{}: {} {} N = {}: {}", name, failed->text("problem"), failed->text("method"),
                           failed->text("intervals"), failed->text("message")));
  }

  [[nodiscard]] static bool is_failure(const Row& row) {
    const Status status = status_named(row.text("status"));
    return !is_solved(status) && !is_no_motion(status);
  }

  [[nodiscard]] std::filesystem::path unfinished_file() const { return prefix_.string() + ".unfinished"; }

  /// Takes over the rows of an interrupted run of the same identity.
  void resume() {
    if (wants_motions() || options_.fresh) return;
    rows_ = parts_.resume(unfinished_file());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!rows_[i]) continue;
      is_own_[i] = false;
      ++resumed_;
    }
    if (resumed_ == 0) return;
    shown_cases_ = static_cast<std::size_t>(own_cases());
    metadata_["resumed_rows"] = resumed_;
    if (findings_.are_for_people()) {
      print_line(fmt::format("{}: resumes an interrupted run, which has {} of {} rows; --fresh solves all of them",
                             experiment_.card().name, resumed_, cases_.size()));
    }
  }

  void save_unfinished() {
    last_saved_ = Clock::now();
    if (!wants_motions()) parts_.save(unfinished_file(), rows_, metadata_);
  }

  void end_unfinished(bool complete) {
    if (!complete) return save_unfinished();
    std::error_code none;  // it need not be there
    std::filesystem::remove(unfinished_file(), none);
  }

  /// Reads the rows of earlier runs that stay in the tables of this one.
  void read_kept_rows() {
    kept_ = KeptRows(prefix_, statements_of(cases_), has_instances(cases_));
    kept_.require_columns(table_file(), names_);
    for (const std::filesystem::path& file : files_of_run({})) {
      require_writable(file);
      kept_.require_no_other_motion(file);
      if (file.extension() == ".csv") kept_.read(file);
    }
    kept_.describe_runs(metadata_);
  }

  [[nodiscard]] static std::set<std::string> names_of_files(const std::vector<std::filesystem::path>& files) {
    std::set<std::string> names;
    for (const std::filesystem::path& file : files) names.insert(file.filename().string());
    return names;
  }

  [[nodiscard]] std::filesystem::path table_file() const {
    return is_child() ? table_of_child_ : std::filesystem::path(prefix_.string() + ".csv");
  }

  /// True in a process that works for another one.
  [[nodiscard]] bool is_child() const { return !table_of_child_.empty(); }

  /// Runs one part: its file is written only when all its rows are there.
  int run_part() {
    const std::string& name = experiment_.card().name;
    if (parts_.is_there()) {
      print_line(fmt::format("{}: part {} is there already: {}", name, options_.part, prefix_.string()));
      return 0;
    }
    const OutputFolder folder(prefix_.parent_path(), true);
    const ResultLock lock(prefix_);
    require_writable(prefix_);
    solve_all();
    throw_if_interrupted();
    parts_.write(rows_, metadata_);
    print_line(fmt::format("{}: part {}: {} of {} rows: {}", name, options_.part, own_cases(), cases_.size(),
                           prefix_.string()));
    return 0;
  }

  [[nodiscard]] int name_missing_parts() const {
    for (const std::size_t number : parts_.missing()) fmt::print("{}\n", number);
    return 0;
  }

  [[nodiscard]] std::ptrdiff_t own_cases() const { return std::ranges::count(is_own_, true); }

  void solve_all() {
    if (experiment_.card().takes_turns) {
      solve_in_turn();
    } else {
      first_solved_ = cases_.empty() ? 0 : reference_of(curves_of(cases_).front());
      if (options_.jobs > 1) {
        solve_in_processes();
      } else {
        solve_span(0, cases_.size());
      }
    }
  }

  [[nodiscard]] std::vector<std::filesystem::path> files_of_run(std::vector<std::filesystem::path> files) const {
    files.insert(files.begin(), table_file());
    for (const std::string& suffix : experiment_.card().further_files) files.emplace_back(prefix_.string() + suffix);
    return files;
  }

  /// The files of an earlier run make room for this one's, except for rows that stay. One that the run starts from is
  /// kept.
  void replace_earlier_files() {
    nlohmann::ordered_json unfinished = metadata_;
    kept_.describe_end(false, unfinished);
    kept_.describe_files(names_of_files(files_of_run({})), unfinished);
    write_metadata(prefix_.string() + ".json", unfinished);
    for (const std::string& suffix : experiment_.card().further_files) {
      const std::string file = prefix_.string() + suffix;
      std::error_code none;  // it need not exist
      if (kept_.count(file) > 0) {
        write_file(file, kept_.alone(file).csv());
      } else if (!is_file_of_motion(file, options_.start)) {
        std::filesystem::remove(file, none);
      }
    }
  }

  /// All rows so far in the order of the cases.
  [[nodiscard]] Table own_rows() const {
    Table table(names_);
    for (const auto& row : rows_) {
      if (row) table.append(*row);
    }
    return table;
  }

  void show(const std::string& activity) { progress_.show(activity, done_, shown_cases_); }

  void solve_span(std::size_t first, std::size_t end) {
    if (options_.batch && options_.repeats == 1 && options_.passed_on.empty()) solve_batches(first, end);
    for (const std::vector<Case>& curve : curves_of(std::span(cases_).subspan(first, end - first))) {
      solve_curve(curve, first);
      first += curve.size();
    }
  }

  /// Cases that batches do not solve are solved alone.
  void solve_batches(std::size_t first, std::size_t end) {
    solve_in_batches({.cases = cases_,
                      .is_wanted = is_own_,
                      .options = solver_options_,
                      .start = [this](const Case& the_case) { return start_of(the_case); },
                      .keep = [this](SolvedCase& solved, std::size_t number) { keep(completed(solved), number); },
                      .show = [this](const std::string& activity) { show(activity); }},
                     {first, end});
  }

  [[nodiscard]] Start start_of(const Case& the_case) {
    Start start = starts_.start_for(the_case);
    if (the_case.start) start.motion = the_case.start(start.motion);
    return start;
  }

  void solve_curve(const std::vector<Case>& curve, std::size_t first) {
    const std::size_t solved_first = reference_of(curve);
    for (std::size_t i = 0; i < curve.size(); ++i) {
      if (interrupt_requested()) return;
      const std::size_t position = i == 0 ? solved_first : i - (i <= solved_first ? 1 : 0);
      if (!is_own_[first + position] || rows_[first + position]) continue;
      SolvedCase solved = solve(first + position, options_.repeats);
      // It was not solved to its end; a motion keeps its last iterate.
      const bool is_cut = interrupt_requested() && !is_solved(solved.solution.status);
      if (is_cut && !wants_motions()) return;
      keep(completed(solved), first + position);
    }
  }

  /// The solved case. Without a start or memory, or if a library fails, its row reports this, and the run goes on. An
  /// error in the first case is an error of the run, unless the case is an instance with its own values.
  SolvedCase solve(std::size_t number, int repeats) {
    const Case& the_case = cases_[number];
    SolvedCase unsolved{.the_case = the_case};
    try {
      SolveTask task{.the_case = the_case,
                     .start = start_of(the_case),
                     .options = solver_options_,
                     .named_options = named_options(options_),
                     .repeats = repeats,
                     .polishes = experiment_.card().polishes};
      show(the_case.label());
      task.options.tolerance = the_case.tolerance.value_or(task.options.tolerance);
      return experiment_.solve(std::move(task));
    } catch (const NoStart& reason) {
      unsolved.solution.status = reason.status;
      unsolved.solution.message = reason.what();
    } catch (const Error& error) {
      if (number == first_solved_ && !the_case.nominal) throw;
      unsolved.solution.message = error.what();
    } catch (const std::exception& error) {
      unsolved.solution.status = is_out_of_memory(error) ? Status::out_of_memory : Status::solver_error;
      unsolved.solution.message = sentence_of(error);
    }
    return unsolved;
  }

  /// The row of a solved case with the experiment's measurements; if memory or time run out, its message reports this.
  Row completed(SolvedCase& solved) {
    MeasuredCase measured{solved, own_columns_.not_measured};
    try {
      const StopScope scope(interrupt_requested, solved.seconds_left);
      if (own_columns_.measure) own_columns_.measure(measured);
    } catch (const Stopped&) {
      note_stop(solved, "Measurements of the answer are missing");
    } catch (const Error&) {
      throw;
    } catch (const std::exception& error) {
      solved.note(fmt::format("Measurements of the answer are missing: {}.", sentence_of(error)));
    }
    if (const std::string advice = in_words(next_to_try(solved, options_.start)); !advice.empty()) solved.note(advice);
    return row_of(columns_, measured);
  }

  /// Grid after grid; the cases that differ in method, solver and variant only are solved in turn.
  void solve_in_turn() {
    const std::vector<std::vector<std::size_t>> turns = turns_of(cases_);
    if (!turns.empty()) first_solved_ = turns.front().front();
    for (const std::vector<std::size_t>& numbers : turns) {  // of one part, each
      if (!interrupt_requested() && is_own_[numbers.front()]) solve_rounds(numbers);
    }
  }

  /// Solves some cases once, then in turn, round after round, each round beginning with another case; the first solves
  /// find memory and caches cold and count where there are no others. If it is interrupted, no case gets a row. Without
  /// other rounds a case gets its row at once, so that its program does not stay in memory.
  void solve_rounds(const std::vector<std::size_t>& numbers) {
    std::vector<SolvedCase> first;
    std::vector<std::vector<Solution>> rounds(numbers.size());
    const int rounds_after_first = options_.repeats > 1 ? options_.repeats : 0;
    for (std::size_t i = 0; i < numbers.size() && rounds_after_first == 0; ++i) {
      SolvedCase solved = solve(numbers[i], 1);
      if (interrupt_requested()) return;
      set_times(solved, {solved.solution});
      keep(completed(solved), numbers[i]);
    }
    if (rounds_after_first == 0) return;
    for (std::size_t round = 0; std::cmp_less_equal(round, rounds_after_first); ++round) {
      for (std::size_t turn = 0; turn < numbers.size(); ++turn) {
        const std::size_t i = (turn + round) % numbers.size();
        if (round > 0 && !is_solved(first[i].solution.status)) continue;
        SolvedCase solved = solve(numbers[i], round == 0 ? 1 : solves_per_round(rounds[i].front()));
        if (interrupt_requested()) return;
        if (round == 1) rounds[i].clear();
        rounds[i].push_back(solved.solution);
        if (round == 0) first.push_back(std::move(solved));
      }
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      set_times(first[i], rounds[i]);
      keep(completed(first[i]), numbers[i]);
    }
  }

  /// The table on disk has every finished row, in the order of solving until the end.
  void keep(Row row, std::size_t number) {
    const std::string line = row.csv(names_);
    rows_[number] = std::move(row);
    ++done_;
    if (parts_.is_one() && !is_child()) return;
    if (std::exchange(has_file_, true)) {
      append_to_file(table_file(), line);
    } else {
      if (!is_child()) replace_earlier_files();
      write_file(table_file(), kept_.joined(table_file(), own_rows()).csv());
    }
    constexpr double seconds_between_saves = 20.0;
    if (!is_child() && seconds_since(last_saved_) > seconds_between_saves) save_unfinished();
  }

  /// A process per problem, of batches per program; its rows come back in a file.
  void solve_in_processes() {
    std::vector<CaseSpan> spans = spans_of_problems(cases_, is_own_);
    if (experiment_.card().takes_batches && options_.batch) spans = spans_of_programs(cases_, spans, parts_.groups());
    std::vector<std::filesystem::path> files;  // named by this process
    files.reserve(spans.size());
    for (const CaseSpan& span : spans) {
      files.push_back(temporary_name(fmt::format("{}_part_{}.csv", prefix_.string(), span.first)));
    }
    const auto work = [&](std::size_t i) {
      table_of_child_ = files[i];
      has_file_ = true;
      rows_.assign(cases_.size(), std::nullopt);  // rows of other problems belong to the parent
      // In a pipe one of all processes reports.
      progress_ = ProgressLine(experiment_.card().name, findings_.are_quiet() || (i > 0 && !progress_.is_shown()));
      done_ = 0;
      const auto first = is_own_.begin() + static_cast<std::ptrdiff_t>(spans[i].first);
      const auto end = is_own_.begin() + static_cast<std::ptrdiff_t>(spans[i].end);
      shown_cases_ = static_cast<std::size_t>(std::count(first, end, true));
      write_file(files[i], Table(names_).csv());
      solve_span(spans[i].first, spans[i].end);
      write_file(files[i], own_rows().csv());
    };
    const auto collect = [&](std::size_t i) {
      const std::filesystem::path& file = files[i];
      if (!std::filesystem::exists(file)) {
        if (interrupt_requested()) return;
        throw Error(fmt::format("the rows of {} are lost: {} has vanished", cases_[spans[i].first].problem->name(),
                                file.string()));
      }
      const Table table = read_table(file);
      std::filesystem::remove(file);
      std::size_t number = spans[i].first;
      for (const Row& row : table.rows()) {
        while (number < spans[i].end && !is_own_[number]) ++number;
        if (number == spans[i].end) throw Error("a process wrote more rows than it had cases");
        keep(row, number++);
        if (progress_.is_shown()) show(row.text("problem"));
      }
    };
    for_each_in_processes(spans.size(), static_cast<std::size_t>(options_.jobs), work, collect);
  }

  Experiment& experiment_;
  Findings& findings_;
  const ExperimentOptions& options_;
  SolverOptions solver_options_;
  std::vector<Case> cases_;
  StartProvider starts_;
  OwnColumns own_columns_;
  Columns<MeasuredCase> columns_;
  std::vector<std::string> names_;
  RowsOfCases rows_;
  KeptRows kept_;
  nlohmann::ordered_json metadata_;
  PartsOfRun parts_;
  std::vector<bool> is_own_;              ///< for every case whether this run works on it, and not another part
  std::filesystem::path prefix_;          ///< of the files: folder and name of the table, or the file of a part
  std::filesystem::path table_of_child_;  ///< of a process that works for another; empty in that one
  ProgressLine progress_;
  Clock::time_point last_saved_ = Clock::now();  ///< the unfinished run
  std::size_t resumed_ = 0;                      ///< rows taken over from an interrupted run
  std::size_t done_ = 0;                         ///< cases
  std::size_t shown_cases_ = 0;                  ///< cases that progress counts: only this process's
  std::size_t first_solved_ = 0;                 ///< the case that the whole run begins with
  bool has_file_ = false;                        ///< a row has been written to the table's file
};

}  // namespace

int run_experiment(Experiment&& experiment, int argc, char** argv) {
  const ExperimentCard& card = experiment.card();
  return run_program(card.name, card.description, argc, argv, [&](CommandLine& line) {
    line.footer(fmt::format("Columns of {}.csv:\n{}", card.name, describe(columns_of(card, experiment.own_columns()))));
    const ExperimentOptions& defaults = card.options;
    line.example(!card.example.empty()
                     ? card.example
                     : fmt::format("--problem {} --intervals {}", defaults.problems.front(), defaults.intervals));
    const bool wants_motions = card.rows == RowUse::motions;
    line.exit_code_1(wants_motions ? "a row is not solved, or is not a motion"
                                   : "a curve has no usable row (its rows have the reasons)");
    add_options(line, experiment.options());
    Findings findings;
    findings.add_to(line);
    line.group("Work");
    if (card.problems_are_independent) add_jobs_option(line, experiment.options());
    if (card.compares_tolerances) add_tolerances_option(line, experiment.options());
    if (card.takes_batches) add_batch_option(line, experiment.options());
    line.group("Of this experiment");
    experiment.add_options(line);
    if (!wants_motions) add_part_options(line, experiment.options());
    const std::vector<std::string> command_line = parse_with_libraries(line);
    return Run(experiment, findings, command_line, line.values_for_results()).run();
  });
}

}  // namespace dmocbench
