#include "bench/run/experiment.hpp"

#include <utility>

#include "bench/run/described_tables.hpp"
#include "bench/run/kept_rows.hpp"

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

}  // namespace dmocbench
