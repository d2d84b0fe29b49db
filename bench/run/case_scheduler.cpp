#include "bench/run/case_scheduler.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "bench/run/advice.hpp"
#include "bench/run/case_batch.hpp"
#include "bench/run/case_list.hpp"
#include "bench/run/error_sentences.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/process_pool.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

CaseScheduler::CaseScheduler(Experiment& experiment, RunPlan& plan, const Columns<MeasuredCase>& columns,
                             const OwnColumns& own, CaseRows& rows, bool is_quiet)
    : experiment_(experiment),
      options_(experiment.options()),
      plan_(plan),
      cases_(plan.cases()),
      columns_(columns),
      own_columns_(own),
      rows_(rows),
      is_quiet_(is_quiet),
      solver_options_(solver_options(options_)),
      starts_({.start = options_.start,
               .most_seconds = options_.start_seconds,
               .reports_branch = experiment.card().branches != BranchReport::none,
               .takes_costates = wants_motions(),
               .reports_branch_from_guess = experiment.card().branches == BranchReport::of_any_start},
              solver_options_),
      progress_(experiment.card().name, is_quiet) {
  starts_.check(cases_);
  starts_.on_progress = [this](const std::string& activity) { show(activity); };
  starts_.on_long_search = [this](const std::string& sentence) {
    if (!progress_.is_shown() && !is_quiet_) fmt::print(stderr, "{}: {}\n", experiment_.card().name, sentence);
  };
  const NamedOptions named = named_options(options_);
  std::set<std::string> solvers;
  for (const Case& the_case : cases_) solvers.insert(the_case.solver);
  for (const std::string& solver : solvers) static_cast<void>(make_solver(solver, solver_options_, named));
}

void CaseScheduler::solve_all() {
  shown_cases_ = plan_.wanted_count();
  if (experiment_.card().takes_turns) return solve_in_turn();
  first_solved_ = cases_.empty() ? 0 : reference_of(curves_of(cases_).front());
  if (options_.jobs > 1) return solve_in_processes();
  solve_span({0, cases_.size()});
}

void CaseScheduler::solve_span(const CaseSpan& span) {
  if (options_.batch && options_.repeats == 1 && options_.passed_on.empty()) solve_batches(span);
  std::size_t first = span.first;
  for (const std::vector<Case>& curve : curves_of(std::span(cases_).subspan(first, span.end - first))) {
    solve_curve(curve, first);
    first += curve.size();
  }
}

/// Cases that batches do not solve are solved alone.
void CaseScheduler::solve_batches(const CaseSpan& span) {
  solve_in_batches({.cases = cases_,
                    .is_wanted = plan_.wanted(),
                    .options = solver_options_,
                    .start = [this](const Case& the_case) { return start_of(the_case); },
                    .keep = [this](SolvedCase& solved, std::size_t number) { keep(solved, number); },
                    .show = [this](const std::string& activity) { show(activity); }},
                   span);
}

void CaseScheduler::solve_curve(const std::vector<Case>& curve, std::size_t first) {
  const std::size_t solved_first = reference_of(curve);
  // From the finest grid on, if that is the reference: the next one replaces it where it is not solved.
  const bool from_finest = curve[solved_first].is_reference && solved_first + 1 == curve.size();
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (interrupt_requested()) return;
    const std::size_t position = from_finest ? solved_first - i
                                 : i == 0    ? solved_first
                                             : i - (i <= solved_first ? 1 : 0);
    if (!plan_.wanted()[first + position]) continue;
    SolvedCase solved = solve(first + position, options_.repeats);
    // It was not solved to its end; a motion keeps its last iterate.
    const bool is_cut = interrupt_requested() && !is_solved(solved.solution.status);
    if (is_cut && !wants_motions()) return;
    keep(solved, first + position);
  }
}

/// Grid after grid; the cases that differ in method, solver and variant only are solved in turn.
void CaseScheduler::solve_in_turn() {
  const std::vector<std::vector<std::size_t>> turns = turns_of(cases_);
  if (!turns.empty()) first_solved_ = turns.front().front();
  for (const std::vector<std::size_t>& numbers : turns) {  // of one part, each
    if (!interrupt_requested() && plan_.wanted()[numbers.front()]) solve_rounds(numbers);
  }
}

/// Solves some cases once, then in turn, round after round, each round beginning with another case; the first solves
/// find memory and caches cold and count where there are no others. If it is interrupted, no case gets a row. Without
/// other rounds a case gets its row at once, so that its program does not stay in memory.
void CaseScheduler::solve_rounds(const std::vector<std::size_t>& numbers) {
  std::vector<SolvedCase> first;
  std::vector<std::vector<Solution>> rounds(numbers.size());
  const int rounds_after_first = options_.repeats > 1 ? options_.repeats : 0;
  for (std::size_t i = 0; i < numbers.size() && rounds_after_first == 0; ++i) {
    SolvedCase solved = solve(numbers[i], 1);
    if (interrupt_requested()) return;
    set_times(solved, {solved.solution});
    keep(solved, numbers[i]);
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
    keep(first[i], numbers[i]);
  }
}

/// A process per problem, of batches per program; it writes a store, which this one collects.
void CaseScheduler::solve_in_processes() {
  std::vector<CaseSpan> spans = spans_of_problems(cases_, plan_.wanted());
  if (experiment_.card().takes_batches && options_.batch)
    spans = spans_of_programs(cases_, spans, plan_.groups_of_starts());
  std::vector<std::filesystem::path> files;  // named by this process
  files.reserve(spans.size());
  for (const CaseSpan& span : spans)
    files.push_back(temporary_name(fmt::format("{}_part_{}.rows", plan_.prefix().string(), span.first)));
  const auto wanted_in = [this](const CaseSpan& span) {
    const auto at = [this](std::size_t number) { return plan_.wanted().begin() + static_cast<std::ptrdiff_t>(number); };
    return static_cast<std::size_t>(std::count(at(span.first), at(span.end), true));
  };
  const auto work = [&](std::size_t i) {
    rows_.write_to(files[i]);
    // In a pipe one of all processes reports.
    progress_ = ProgressLine(experiment_.card().name, is_quiet_ || (i > 0 && !progress_.is_shown()));
    done_ = 0;
    shown_cases_ = wanted_in(spans[i]);
    solve_span(spans[i]);
  };
  const auto collect = [&](std::size_t i) {
    for (const std::size_t number : rows_.collect(files[i])) {
      plan_.settle(number);
      ++done_;
      if (progress_.is_shown()) show(cases_[number].problem->name());
    }
    if (wanted_in(spans[i]) == 0 || interrupt_requested()) return;
    throw Error("the rows of {} are lost, because {} no longer exists", cases_[spans[i].first].problem->name(),
                files[i].string());
  };
  for_each_in_processes(spans.size(), static_cast<std::size_t>(options_.jobs), work, collect);
}

Start CaseScheduler::start_of(const Case& the_case) {
  Start start = starts_.start_for(the_case);
  if (the_case.start) start.motion = the_case.start(start.motion);
  return start;
}

/// The solved case. Without a start or memory, or if a library fails, its row reports this, and the run goes on. An
/// error in the first case is an error of the run, unless the case is an instance with its own values.
SolvedCase CaseScheduler::solve(std::size_t number, int repeats) {
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

/// The row of a solved case with the experiment's measurements; its message reports one that fails, and if memory or
/// time run out.
Row CaseScheduler::completed(SolvedCase& solved) {
  MeasuredCase measured{solved, own_columns_.not_measured};
  try {
    const StopScope scope(interrupt_requested, solved.seconds_left);
    if (own_columns_.measure) own_columns_.measure(measured);
  } catch (const Stopped&) {
    note_stop(solved, "Measurements of the solution are missing");
  } catch (const Error& error) {
    solved.note(error.what());
  } catch (const std::exception& error) {
    solved.note(fmt::format("Measurements of the solution are missing: {}.", sentence_of(error)));
  }
  if (const std::string advice = in_words(next_to_try(solved, options_.start)); !advice.empty()) solved.note(advice);
  return row_of(columns_, measured);
}

void CaseScheduler::keep(SolvedCase& solved, std::size_t number) {
  rows_.keep(number, completed(solved));
  plan_.settle(number);
  ++done_;
}

}  // namespace dmocbench
