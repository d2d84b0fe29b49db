#include "bench/experiment/experiment.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiment/interrupt.hpp"
#include "bench/experiment/metadata.hpp"
#include "bench/experiment/process_pool.hpp"
#include "bench/experiment/progress.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/experiment/start_provider.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

constexpr int exit_solved = 0;
constexpr int exit_some_failed = 1;
constexpr int exit_interrupted = 130;
constexpr int most_jobs = 256;

/// The first case behind `first` that is not on its curve.
std::size_t end_of_curve(const std::vector<Case>& cases, std::size_t first) {
  std::size_t last = first + 1;
  while (last < cases.size() && cases[last].same_curve(cases[first])) ++last;
  return last;
}

std::vector<Case> part(const std::vector<Case>& cases, std::size_t first, std::size_t last) {
  return {cases.begin() + static_cast<std::ptrdiff_t>(first), cases.begin() + static_cast<std::ptrdiff_t>(last)};
}

std::vector<Case> with_variants(const Experiment& experiment, const std::vector<Case>& cases) {
  std::vector<Case> result;
  for (std::size_t first = 0; first < cases.size();) {
    const std::size_t last = end_of_curve(cases, first);
    const std::vector<Case> variants = experiment.variants(part(cases, first, last));
    result.insert(result.end(), variants.begin(), variants.end());
    first = last;
  }
  return result;
}

/// One run of an experiment: its cases, its table, its files.
class Run {
 public:
  Run(Experiment& experiment, const ExperimentOptions& options, const std::vector<std::string>& command_line)
      : experiment_(experiment),
        options_(options),
        solver_options_(solver_options(options)),
        cases_(with_variants(experiment, expand_cases(options))),
        starts_(options.start, with_interrupt(solver_options_)),
        rows_(cases_.size()),
        prefix_(options.out / options.name),
        metadata_(describe_run(command_line)) {
    experiment_.check(cases_);
    starts_.check(cases_);
    solver_options_ = with_interrupt(solver_options_);
    for (const std::string& solver : options.solvers) static_cast<void>(make_solver(solver, solver_options_));
  }

  int run() {
    prepare_folder(options_.out);
    experiment_.prepare(options_.out);
    listen_for_interrupt();
    Progress progress(cases_.size());
    starts_.on_progress = [&](const std::string& what) { progress.show(what); };
    if (options_.jobs > 1) {
      solve_in_processes(progress);
    } else {
      solve_part(0, cases_.size(), progress);
    }
    const bool complete = !interrupt_requested();
    if (complete) experiment_.finish(table(), prefix_, metadata_);
    write_metadata(complete);
    if (!complete) return exit_interrupted;
    return failures_ > 0 ? exit_some_failed : exit_solved;
  }

  [[nodiscard]] std::string summary() const {
    const auto done = static_cast<std::size_t>(
        std::count_if(rows_.begin(), rows_.end(), [](const auto& row) { return row.has_value(); }));
    return fmt::format("{} rows, {} not solved, {} on another branch: {}.csv", done, failures_, other_branch_,
                       prefix_.string());
  }

 private:
  static SolverOptions with_interrupt(SolverOptions options) {
    options.stop_requested = interrupt_requested;
    return options;
  }

  void solve_part(std::size_t first, std::size_t end, Progress& progress) {
    while (first < end && !interrupt_requested()) {
      const std::size_t last = end_of_curve(cases_, first);
      solve_curve(first, last, progress);
      first = last;
    }
  }

  /// A process per problem; its rows come back in a file.
  void solve_in_processes(Progress& progress) {
    std::vector<std::size_t> heads;  // first case of every problem, then the end
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (i == 0 || cases_[i].problem != cases_[i - 1].problem) heads.push_back(i);
    }
    heads.push_back(cases_.size());
    const std::filesystem::path whole = prefix_;
    const auto part_of = [&](std::size_t i) { return whole.string() + "_part_" + std::to_string(i); };
    const auto work = [&](std::size_t i) {
      prefix_ = part_of(i);
      rows_.assign(cases_.size(), std::nullopt);  // those of other problems are the parent's
      write_file(prefix_.string() + ".csv", table().csv());
      solve_part(heads[i], heads[i + 1], progress);
    };
    const auto collect = [&](std::size_t i) {
      const std::filesystem::path file = part_of(i) + ".csv";
      if (!std::filesystem::exists(file)) return;  // it ended before it had written anything
      const Table part = Table::from_csv(read_file(file));
      std::filesystem::remove(file);
      for (const Row& row : part.rows()) keep(row, heads[i], heads[i + 1], progress);
      write_file(whole.string() + ".csv", table().csv());
    };
    for_each_in_processes(heads.size() - 1, static_cast<std::size_t>(options_.jobs), work, collect);
  }

  void keep(const Row& row, std::size_t first, std::size_t end, Progress& progress) {
    while (first < end && rows_[first]) ++first;
    if (first == end) throw Error("a process wrote more rows than it had cases");
    rows_[first] = row;
    count(row);
    progress.advance();
    progress.show(row.text("problem"));
  }

  void count(const Row& row) {
    if (!is_solved(status_named(row.text("status")))) ++failures_;
    if (row.text("branch") == "other") ++other_branch_;
  }

  void solve_curve(std::size_t first, std::size_t last, Progress& progress) {
    const std::vector<Case> curve = part(cases_, first, last);
    for (const std::size_t position : experiment_.solving_order(curve)) {
      const Case& what = curve[position];
      if (interrupt_requested()) return;
      SolvedCase solved = solve(what, progress);
      if (interrupt_requested() && !is_solved(solved.solution.status)) return;  // half a solve is no row
      experiment_.complete(solved);
      count(solved.row);
      rows_[first + position] = std::move(solved.row);
      write_file(prefix_.string() + ".csv", table().csv());
      progress.advance();
    }
  }

  /// The solved case; without a start its row says so, and the run goes on.
  SolvedCase solve(const Case& what, const Progress& progress) {
    try {
      const Start start{.motion = experiment_.start_for(what, starts_.motion_for(what)),
                        .branch = experiment_.tells_branches() ? starts_.branch_for(what) : std::nullopt};
      progress.show(what.label());
      return solve_case(what, start, experiment_.options_for(what, solver_options_), options_.repeats,
                        experiment_.polishes());
    } catch (const NoStart& reason) {
      return unsolved_case(what, reason.what());
    }
  }

  [[nodiscard]] Table table() const {
    std::vector<std::string> columns = core_columns();
    for (const std::string& column : experiment_.own_columns()) columns.push_back(column);
    Table table(columns);
    for (const auto& row : rows_) {
      if (row) table.append(*row);
    }
    return table;
  }

  void write_metadata(bool complete) {
    metadata_["complete"] = complete;
    metadata_["rows"] = table().rows().size();
    metadata_["not_solved"] = failures_;
    metadata_["on_another_branch"] = other_branch_;
    write_file(prefix_.string() + ".json", metadata_.dump(2) + "\n");
  }

  Experiment& experiment_;
  const ExperimentOptions& options_;
  SolverOptions solver_options_;
  std::vector<Case> cases_;
  StartProvider starts_;
  std::vector<std::optional<Row>> rows_;
  std::filesystem::path prefix_;
  nlohmann::ordered_json metadata_;
  std::size_t failures_ = 0;
  std::size_t other_branch_ = 0;
};

}  // namespace

std::vector<std::size_t> Experiment::solving_order(const std::vector<Case>& curve) const {
  std::vector<std::size_t> order(curve.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

int run_experiment(Experiment& experiment, int argc, char** argv) {
  CommandLine line(experiment.description(), experiment.name());
  ExperimentOptions options;
  options.intervals = experiment.default_intervals();
  options.name = experiment.name();
  experiment.set_defaults(options);
  add_options(line, options);
  if (experiment.problems_are_independent()) {
    line.option("--jobs", options.jobs, "problems worked on at the same time, each in a process of its own")
        .range(1, most_jobs)
        .shows_default();
  }
  experiment.add_options(line);
  return run_program(line, argc, argv, [&] {
    Run run(experiment, options, std::vector<std::string>(argv, argv + argc));
    const int code = run.run();
    fmt::print("{}: {}\n", experiment.name(), run.summary());
    return code;
  });
}

}  // namespace dmocbench
