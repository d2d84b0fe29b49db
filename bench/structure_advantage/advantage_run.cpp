#include "bench/structure_advantage/advantage_run.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/experiment/interrupt.hpp"
#include "bench/experiment/metadata.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/structure_advantage/advantage_ratios.hpp"
#include "bench/structure_advantage/banded_kkt.hpp"
#include "bench/structure_advantage/operation_count.hpp"
#include "methods/error.hpp"
#include "methods/numerics/median.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"

namespace dmocbench {

namespace {

constexpr int exit_solved = 0;
constexpr int exit_some_failed = 1;
constexpr int exit_interrupted = 130;

constexpr const char* structured_solver = "interior_point";

const std::vector<std::string> own_columns{"factorisation",
                                           "linear_systems",
                                           "smallest_seconds",
                                           "seconds_per_iteration",
                                           "linear_algebra_per_iteration",
                                           "seconds_per_linear_system",
                                           "operations_per_interval",
                                           "elimination_operations_per_interval",
                                           "half_bandwidth",
                                           "objective_error"};

/// The ways to solve a case. Solvers but ours have none to choose.
std::vector<std::string> ways_of(const Case& what, const std::vector<std::string>& chosen) {
  if (what.solver != structured_solver) return {""};
  std::vector<std::string> ways;
  for (const std::string& way : factorisation_names()) {
    const bool is_chosen = std::find(chosen.begin(), chosen.end(), way) != chosen.end();
    if (is_chosen) ways.push_back(way);
  }
  return ways;
}

/// The solver by the way of the case. The band is no factorisation of the method's own.
std::unique_ptr<Solver> make_solver_of(const Case& what, SolverOptions options) {
  if (what.variant == "banded") {
    InteriorPointOptions choices;
    choices.make_kkt_system = [](NonlinearProgram& program) {
      return std::make_unique<interior_point::BandedKkt>(program);
    };
    return std::make_unique<InteriorPointSolver>(std::move(options), std::move(choices));
  }
  if (!what.variant.empty()) options.passed_on["factorisation"] = what.variant;
  return make_solver(what.solver, options);
}

}  // namespace

const std::vector<std::string>& factorisation_names() {
  static const std::vector<std::string> names{"intervals", "banded", "sparse"};
  return names;
}

AdvantageRun::AdvantageRun(const ExperimentOptions& options, const std::vector<std::string>& factorisations,
                           const std::vector<std::string>& command_line)
    : options_(options),
      solver_options_(solver_options(options)),
      starts_(options.start, solver_options_),
      reference_(options.out),
      prefix_(options.out / options.name),
      metadata_(describe_run(command_line)) {
  for (const std::string& name : factorisations) {
    const auto& known = factorisation_names();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw Error(fmt::format("--factorisation takes {}, not {}", fmt::join(known, ", "), name));
    }
  }
  const std::vector<Case> all = expand_cases(options);
  std::vector<Case> cases;
  for (std::size_t first = 0; first < all.size();) {
    std::size_t last = first;
    while (last < all.size() && all[last].same_curve(all[first])) ++last;
    for (const std::string& way : ways_of(all[first], factorisations)) {
      for (std::size_t i = first; i < last; ++i) {
        cases.push_back(all[i]);
        cases.back().variant = way;
        static_cast<void>(make_solver_of(cases.back(), solver_options_));
      }
    }
    first = last;
  }
  starts_.check(cases);
  for (Case& what : cases) subjects_.push_back({std::move(what), std::nullopt, {}, {}, {}});
  solver_options_.stop_requested = interrupt_requested;
}

/// Subjects that differ in method and solver only.
std::vector<std::vector<std::size_t>> AdvantageRun::groups() const {
  std::map<std::tuple<std::string, std::string, int, std::size_t>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    const Case& what = subjects_[i].what;
    groups[{what.problem->name(), what.tableau, what.stages, what.intervals()}].push_back(i);
  }
  std::vector<std::vector<std::size_t>> result;
  result.reserve(groups.size());
  for (auto& [unused, members] : groups) result.push_back(std::move(members));
  return result;
}

void AdvantageRun::solve_once(Subject& subject, const Progress& progress) {
  const Case& what = subject.what;
  try {
    const Start start{.motion = starts_.motion_for(what), .branch = starts_.branch_for(what)};
    progress.show(what.label());
    SolvedCase solved = solve_case(what, start, solver_options_, repeats_of(subject), false, make_solver_of);
    subject.seconds.push_back(solved.solution.seconds);
    subject.evaluation_seconds.push_back(solved.solution.evaluation_seconds);
    if (solved.solution.linear_seconds) subject.linear_seconds.push_back(*solved.solution.linear_seconds);
    if (!subject.solved) subject.solved = std::move(solved);
  } catch (const NoStart& reason) {
    subject.solved = unsolved_case(what, reason.what());
  }
}

/// How often a solve is repeated within a round, of which the median counts: short ones often, so that an interruption
/// by something else is an outlier; never in the first round, which tells how long one takes.
int AdvantageRun::repeats_of(const Subject& subject) {
  constexpr double seconds_of_a_round = 0.02;
  constexpr double most = 40.0;
  if (subject.seconds.empty()) return 1;
  return static_cast<int>(std::clamp(seconds_of_a_round / subject.seconds.front(), 1.0, most));
}

void AdvantageRun::solve_group(const std::vector<std::size_t>& group, Progress& progress) {
  for (int round = 0; round < options_.repeats; ++round) {
    for (const std::size_t i : group) {
      Subject& subject = subjects_[i];
      const bool failed_before = subject.solved && !is_solved(subject.solved->solution.status);
      if (interrupt_requested()) break;
      if (!failed_before) solve_once(subject, progress);
    }
  }
  for (const std::size_t i : group) {
    Subject& subject = subjects_[i];
    if (interrupt_requested()) {
      subject.solved.reset();  // half a group is none
      continue;
    }
    complete(subject);
    progress.advance();
  }
  write_file(prefix_.string() + ".csv", table().csv());
}

void AdvantageRun::complete(Subject& subject) {
  if (!subject.solved) return;
  SolvedCase& solved = *subject.solved;
  Row& row = solved.row;
  row.set("factorisation", solved.what.variant);
  row.set("linear_systems", solved.solution.linear_systems);
  if (!is_solved(solved.solution.status)) {
    ++failures_;
    return;
  }
  const double seconds = median(subject.seconds);
  const double evaluation_seconds = median(subject.evaluation_seconds);
  row.set("seconds", seconds);
  row.set("evaluation_seconds", evaluation_seconds);
  row.set("smallest_seconds", *std::min_element(subject.seconds.begin(), subject.seconds.end()));
  const int iterations = solved.solution.major_iterations.value_or(0);
  if (iterations > 0) {
    row.set("seconds_per_iteration", seconds / iterations);
    row.set("linear_algebra_per_iteration", (seconds - evaluation_seconds) / iterations);
  }
  const int systems = solved.solution.linear_systems.value_or(0);
  if (!subject.linear_seconds.empty() && systems > 0) {
    row.set("seconds_per_linear_system", median(subject.linear_seconds) / systems);
  }
  const Case& what = solved.what;
  Transcription program(*what.problem, *make_element(what.method), make_tableau(what.tableau, what.stages), what.grid);
  const OperationCount count = count_operations(program, solved.solution, what.variant);
  const auto intervals = static_cast<double>(what.intervals());
  if (count.elimination) {
    row.set("operations_per_interval", *count.elimination / intervals);
    row.set("elimination_operations_per_interval", *count.elimination / intervals);
  }
  row.set("half_bandwidth", count.half_bandwidth);
  measure_error(solved, row);
}

/// Against the indirect solution's cost; a row whose problem has none keeps the reason.
void AdvantageRun::measure_error(const SolvedCase& solved, Row& row) {
  if (!is_usable(row) || !solved.trajectory) return;
  try {
    const double exact = reference_.near(*solved.what.problem, *solved.trajectory).cost();
    row.set("objective_error", std::abs(solved.trajectory->cost - exact) / std::abs(exact));
  } catch (const Error& error) {
    row.set("message", row.text("message") + " " + error.what());
  }
}

Table AdvantageRun::table() const {
  std::vector<std::string> columns = core_columns();
  columns.insert(columns.end(), own_columns.begin(), own_columns.end());
  Table table(columns);
  for (const Subject& subject : subjects_) {
    if (subject.solved) table.append(subject.solved->row);
  }
  return table;
}

int AdvantageRun::run() {
  prepare_folder(options_.out);
  listen_for_interrupt();
  Progress progress(subjects_.size());
  starts_.on_progress = [&](const std::string& what) { progress.show(what); };
  for (const auto& group : groups()) {
    if (!interrupt_requested()) solve_group(group, progress);
  }
  const bool complete = !interrupt_requested();
  if (complete) write_file(prefix_.string() + "_ratios.csv", advantage_ratios(table()).csv());
  metadata_["repeats"] = options_.repeats;
  metadata_["references"] = reference_.metadata();
  metadata_["complete"] = complete;
  metadata_["rows"] = table().rows().size();
  metadata_["not_solved"] = failures_;
  write_file(prefix_.string() + ".json", metadata_.dump(2) + "\n");
  if (!complete) return exit_interrupted;
  return failures_ > 0 ? exit_some_failed : exit_solved;
}

std::string AdvantageRun::summary() const {
  return fmt::format("{} rows, {} not solved: {}.csv", table().rows().size(), failures_, prefix_.string());
}

}  // namespace dmocbench
