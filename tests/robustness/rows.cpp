#include "tests/robustness/rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "methods/transcription/elements/families.hpp"

namespace dmocbench::tests {

bool told_apart(const Solution& solution, const Accuracy& replay) {
  return is_solved(solution.status) && !(replay.relative_jump <= largest_relative_jump);
}

namespace {

Row run_row(const Problem& problem, const std::string& method, const Setting& setting, const std::string& solver) {
  const auto program = transcribe(problem, {method, setting.stages}, Grid::uniform(setting.intervals));
  SolverOptions options;
  options.most_iterations = 300;
  options.most_seconds = 20.0;
  Row row;
  row.label = fmt::format("{}, {} s={} N={}, {}", problem.name(), method, setting.stages, setting.intervals, solver);
  row.solution = make_solver(solver, options)->solve(*program, sample(*program, guessed_motion(problem)));
  row.cost = row.solution.objective / program->cost_scale();
  row.replay.relative_jump = std::numeric_limits<double>::infinity();
  if (is_solved(row.solution.status)) {
    row.replay = accuracy(problem, read_trajectory(*program, row.solution.primal, row.solution.multipliers));
  }
  fmt::print("{:58} {:15} cost {:<12.7g} jump {:.1e} in {:2}, {:3} iterations, {:.3f} s\n", row.label,
             name_of(row.solution.status), row.cost, row.replay.relative_jump, row.replay.interval,
             row.solution.major_iterations.value_or(0), row.solution.seconds);
  return row;
}

bool is_given_as_a_motion(const Row& row) {
  return is_solved(row.solution.status) && !told_apart(row.solution, row.replay);
}

std::vector<Row> run_rows(const Problem& problem, const Setting& setting) {
  std::vector<Row> rows;
  for (const std::string& method : paper_families()) {
    for (const char* solver : {"ipopt", "interior_point"}) rows.push_back(run_row(problem, method, setting, solver));
  }
  return rows;
}

}  // namespace

void expect_rows(const Problem& problem, const std::vector<double>& minima, const Setting& setting) {
  const double cheapest = *std::ranges::min_element(minima);
  int at_minimum = 0;
  for (const Row& row : run_rows(problem, setting)) {
    if (!is_given_as_a_motion(row)) continue;
    EXPECT_LE(row.replay.relative_jump, largest_relative_jump) << row.label;
    EXPECT_GT(row.cost, cheapest * (1.0 - setting.accuracy)) << row.label << ": no motion is as cheap";
    const auto is_minimum = [&](double minimum) { return std::abs(row.cost - minimum) < setting.accuracy * minimum; };
    if (std::ranges::any_of(minima, is_minimum)) ++at_minimum;
  }
  EXPECT_GE(at_minimum, setting.least_at_minimum)
      << problem.name() << ", s=" << setting.stages << ", N=" << setting.intervals;
}

void expect_no_motion(const Problem& problem, const Setting& setting) {
  for (const Row& row : run_rows(problem, setting)) {
    EXPECT_FALSE(is_given_as_a_motion(row)) << row.label << " of cost " << row.cost;
  }
}

}  // namespace dmocbench::tests
