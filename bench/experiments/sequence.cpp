// Problems that follow each other, each started from the answer of the one before: receding horizon and homotopy.
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/experiments/sequence/solved_steps.hpp"
#include "bench/run/column.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/options.hpp"
#include "bench/run/start_provider.hpp"
#include "bench/run/table_run.hpp"
#include "methods/error.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"

namespace dmocbench::sequence_program {

/// The choices of a user.
struct SequenceOptions {
  ProblemOptions problems{.problems = paper_problem_names()};
  std::vector<std::string> methods = paper_families();
  int intervals = 64;
  int steps = 200;
  int repeats = 3;
  std::uint64_t seed = 1;
  std::string over = {};
};

/// The homotopy of a problem: the user's quantity, or else a parameter of the paper's problems; empty for others.
std::optional<SweptQuantity> homotopy_of(const SequenceOptions& options, const Problem& problem) {
  if (!options.over.empty()) {
    const SweptQuantity quantity = parse_over(options.over, true);
    require_quantities(problem, {quantity});
    return quantity;
  }
  if (problem.name() == "orbital_transfer") return SweptQuantity{"target_altitude", 330.0, 660.0};
  if (problem.name() == "two_link_manipulator") return SweptQuantity{"mass_1", 1.0, 2.0};
  return std::nullopt;
}

/// The first problem of each method solved from the common start. Throws `Error` if one is not.
std::vector<SolvedCase> first_answers(const SequenceOptions& options, const std::shared_ptr<const Problem>& problem,
                                      StartProvider& starts, const SolverOptions& solver_options) {
  const auto solver = make_solver("auto", solver_options);
  std::vector<SolvedCase> answers;
  for (const std::string& method : options.methods) {
    const Case the_case{
        .problem = problem, .method = method, .solver = "interior_point", .grid = Grid::uniform(options.intervals)};
    answers.push_back(solve_case(the_case, starts.start_for(the_case), *solver, solver_options.tolerance, 1));
    throw_if_interrupted();
    const SolvedCase& answer = answers.back();
    if (answer.trajectory && is_solved(answer.solution.status)) continue;
    throw Error("no sequence can start because {} is not solved: {}", the_case.label(), answer.solution.message);
  }
  return answers;
}

/// Throws `Error` if a problem has no sequence.
void require_sequence(const SequenceOptions& options, const std::shared_ptr<const Problem>& problem,
                      StartProvider& starts, const SolverOptions& solver_options) {
  if (problem->bounds().horizon.is_free()) {
    throw Error("{} has a free horizon; a receding horizon needs a fixed horizon; choose another problem",
                problem->name());
  }
  if (problem->phased() != nullptr && !homotopy_of(options, *problem)) {
    throw Error(
        "{} has phases, which a receding horizon does not support; vary a quantity with --over "
        "NAME=LOWER:UPPER, or choose another problem",
        problem->name());
  }
  static_cast<void>(first_answers(options, problem, starts, solver_options));
}

/// All methods through one kind of sequence, step by step in turn, so that other load of the machine slows all alike.
void run_in_turn(std::vector<SequenceRun>& runs, const SequenceOptions& options, std::vector<SequenceStep>& steps) {
  constexpr int steps_between_cold_solves = 5;
  for (int step = 0; step < options.steps; ++step) {
    for (std::size_t turn = 0; turn < runs.size(); ++turn) {
      throw_if_interrupted();
      SequenceRun& run = runs[(turn + static_cast<std::size_t>(step)) % runs.size()];
      if (!run.is_at_end()) steps.push_back(run.next(step % steps_between_cold_solves == 0));
    }
  }
}

std::vector<SequenceStep> run_problem(const SequenceOptions& options, const std::shared_ptr<const Problem>& problem,
                                      StartProvider& starts, const SolverOptions& solver_options) {
  const std::optional<SweptQuantity> quantity = homotopy_of(options, *problem);
  const bool has_phases = problem->phased() != nullptr;
  std::vector<SequenceStep> steps;
  const std::vector<SolvedCase> answers = first_answers(options, problem, starts, solver_options);
  // NOLINTNEXTLINE(bugprone-unchecked-optional-access): every one of them is solved
  const Trajectory& motion = *answers.front().trajectory;
  constexpr double disturbance = 0.01;  // of the initial states, a share of the range of the first motion
  std::vector<SequenceRun> receding;
  std::vector<SequenceRun> continued;
  for (const SolvedCase& answer : answers) {
    if (!has_phases) {
      receding.emplace_back(answer, receding_horizon(problem, motion, disturbance, options.seed), solver_options,
                            options.repeats);
    }
    if (!quantity) continue;
    continued.emplace_back(answer, homotopy(problem, options.problems.settings, *quantity, options.steps),
                           solver_options, options.repeats);
  }
  run_in_turn(receding, options, steps);
  run_in_turn(continued, options, steps);
  return steps;
}

void add_options(CommandLine& line, SequenceOptions& options) {
  options.problems.add_to(line);
  line.list("--method", options.methods, fmt::format("methods: {}", fmt::join(paper_families(), ", ")));
  line.number("--intervals", options.intervals, 2, 4096, "number of intervals N");
  line.number("--steps", options.steps, 1, 100000, "number of problems in each sequence");
  line.number("--repeats", options.repeats, 1, 1000, "number of solves per step; the shortest time is used");
  line.number("--seed", options.seed, 0, 0xffffffffU, "seed of the disturbances");
  line.option("--over", options.over, "parameter or end state that a homotopy changes, as NAME=LOWER:UPPER");
}

int run_sequences(CommandLine& line) {
  SequenceOptions options;
  add_options(line, options);
  TableRun run("sequence", line, TableRun::Resumes::yes);
  options.methods = chosen_of("--method", paper_families(), options.methods);
  const auto problems = run.selected(options.problems);
  const SolverOptions solver_options = TableRun::solver_options();
  StartProvider starts({}, solver_options);
  for (const auto& problem : problems) require_sequence(options, problem, starts, solver_options);
  for (const auto& problem : problems) {
    run.stage(problem->name(), [&] {
      run.show(problem->name());
      const std::vector<SequenceStep> steps = run_problem(options, problem, starts, solver_options);
      run.add("sequence", step_table(steps));
      run.add("sequence_summary", sequence_summary(steps));
    });
  }
  run.summary().show("sequences", run.table("sequence_summary"),
                     {"problem", "method", "sequence", "steps", "solved", "median_iterations", "median_cold_iterations",
                      "median_microseconds", "p99_microseconds"},
                     "sequence_summary.csv");
  return run.write();
}

int run(int argc, char** argv) {
  return run_program("sequence",
                     "Solves sequences of problems, each started from the trajectory, multipliers and barrier "
                     "parameter of the previous problem: a receding horizon with disturbances, and a homotopy in a "
                     "parameter. sequence.csv has the iterations and microseconds of every step, warm and cold; "
                     "sequence_summary.csv has their median, 99th percentile and maximum.",
                     argc, argv, run_sequences);
}

}  // namespace dmocbench::sequence_program
