#pragma once

#include <memory>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "bench/run/solve_case.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/transcription/start.hpp"

namespace dmocbench::speed {

/// A program to be timed, with the guess of its problem as start.
struct GuessedProgram {
  std::shared_ptr<const Problem> problem;
  std::unique_ptr<Transcription> program;
  double setup_seconds = 0.0;  ///< that making the program took
  Eigen::VectorXd start;       ///< program->variable_count() entries

  /// Transcribes by Gauss on intervals of equal length. Throws `Error` as `Transcription` does.
  GuessedProgram(std::shared_ptr<const Problem> of, const std::string& method, int intervals, int stages = 1,
                 const std::string& derivatives = "tape")
      : problem(std::move(of)) {
    const Clock::time_point begin = Clock::now();
    program = Case{.problem = problem,
                   .method = method,
                   .stages = stages,
                   .derivatives = derivatives,
                   .grid = Grid::uniform(intervals)}
                  .transcribe();
    setup_seconds = seconds_since(begin);
    start = sample(*program, guessed_motion(*problem));
  }
};

}  // namespace dmocbench::speed
