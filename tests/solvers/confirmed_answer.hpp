#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "methods/judgement/polish.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench::tests {

/// A program with its answer.
struct Answer {
  std::unique_ptr<Transcription> program;
  Solution solution;
  Trajectory motion;
};

/// Solves to a tolerance and then to rounding; the test fails where the answer is not confirmed.
inline Answer confirmed(const Problem& problem, const Scheme& scheme, Eigen::Index intervals, const Motion& start,
                        double tolerance, const std::string& solver = "interior_point") {
  Answer answer{transcribe(problem, scheme, Grid::uniform(intervals)), {}, {}};
  SolverOptions options;
  options.tolerance = tolerance;
  answer.solution = make_solver(solver, options)->solve(*answer.program, sample(*answer.program, start));
  settle(*answer.program, options.tolerance, answer.solution);
  polish(*answer.program, answer.solution);
  EXPECT_TRUE(is_solved(answer.solution.status))
      << problem.name() << ", " << scheme.label() << ", N = " << intervals << ": " << answer.solution.message;
  answer.motion = read_trajectory(*answer.program, answer.solution.primal, answer.solution.multipliers);
  return answer;
}

}  // namespace dmocbench::tests
