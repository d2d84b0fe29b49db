#pragma once

#include <algorithm>

#include <benchmark/benchmark.h>

#include "bench/speed/guessed_program.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench::speed {

/// Every turn of the timed loop is one solve from the guess. A solver's set-up before its first
/// iteration is part of it; the trace, its derivatives and judging the answer are not. Sets the counters of the solve
/// and returns the answer of the last one.
inline Solution time_solves(benchmark::State& state, const Solver& solver, const GuessedProgram& made) {
  constexpr double nanoseconds = 1e9;  // of a second
  Solution solution;
  double seconds = 0.0;
  double evaluation_seconds = 0.0;
  for ([[maybe_unused]] auto turn : state) {
    solution = solver.solve(*made.program, made.start);
    state.SetIterationTime(solution.seconds);
    seconds += solution.seconds;
    evaluation_seconds += solution.evaluation_seconds;
  }
  const double iterations = solution.major_iterations.value_or(0);
  const auto intervals = static_cast<double>(made.program->interval_structure()->intervals);
  const double interval_turns = static_cast<double>(state.iterations()) * intervals;
  state.counters["major_iterations"] = iterations;
  if (solution.linear_systems) state.counters["linear_systems"] = *solution.linear_systems;
  state.counters["objective"] = solution.objective;
  state.counters["solved"] = is_solved(solution.status) ? 1.0 : 0.0;
  state.counters["evaluation_share"] = evaluation_seconds / seconds;
  state.counters["ns_per_interval_iteration"] = nanoseconds * seconds / interval_turns / std::max(1.0, iterations);
  state.counters["setup_seconds"] = made.setup_seconds;
  return solution;
}

}  // namespace dmocbench::speed
