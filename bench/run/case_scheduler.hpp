#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/run/case_rows.hpp"
#include "bench/run/column.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/run_plan.hpp"
#include "bench/run/start_provider.hpp"

namespace dmocbench {

/// Makes the rows of a plan that are wanted: finds the starts of their cases, solves and measures them, and keeps their
/// rows as soon as they are there. It solves case after case in the order of the plan, the reference of a curve first;
/// or grid after grid in turn, round after round, where times are compared (`ExperimentCard::takes_turns`); several
/// cases of one program side by side (--batch); problems in processes of their own (--jobs). An interrupt ends it
/// early.
class CaseScheduler {
 public:
  /// `columns`: of the table; `own`: the columns among them that the experiment adds. Throws `Error` if a start does
  /// not fit or an option of a solver is unknown.
  CaseScheduler(Experiment& experiment, RunPlan& plan, const Columns<MeasuredCase>& columns, const OwnColumns& own,
                CaseRows& rows, bool is_quiet);
  CaseScheduler(const CaseScheduler&) = delete;
  CaseScheduler& operator=(const CaseScheduler&) = delete;
  ~CaseScheduler() = default;

  /// Solves everything that is wanted. Throws `Error` if nothing of the kind can be solved (the first case fails), or a
  /// file cannot be written.
  void solve_all();

 private:
  void show(const std::string& activity) { progress_.show(activity, done_, shown_cases_); }
  [[nodiscard]] bool wants_motions() const { return experiment_.card().rows == RowUse::motions; }
  void solve_span(const CaseSpan& span);
  void solve_batches(const CaseSpan& span);
  void solve_curve(const std::vector<Case>& curve, std::size_t first);
  void solve_in_turn();
  void solve_rounds(const std::vector<std::size_t>& numbers);
  void solve_in_processes();
  [[nodiscard]] Start start_of(const Case& the_case);
  [[nodiscard]] SolvedCase solve(std::size_t number, int repeats);
  [[nodiscard]] Row completed(SolvedCase& solved);
  void keep(SolvedCase& solved, std::size_t number);

  Experiment& experiment_;
  const ExperimentOptions& options_;
  RunPlan& plan_;
  const std::vector<Case>& cases_;
  const Columns<MeasuredCase>& columns_;
  const OwnColumns& own_columns_;
  CaseRows& rows_;
  bool is_quiet_;
  SolverOptions solver_options_;
  StartProvider starts_;
  ProgressLine progress_;
  std::size_t done_ = 0;          ///< cases
  std::size_t shown_cases_ = 0;   ///< cases that progress counts: only this process's
  std::size_t first_solved_ = 0;  ///< the case that the whole run begins with
};

}  // namespace dmocbench
