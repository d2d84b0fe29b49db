#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/speed/solve_name.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench::speed {

/// Beyond it a solve counts as failed.
inline constexpr double most_seconds_of_a_solve = 60.0;

/// Names of the problems that are solved on every grid: the paper's two and, with inequalities, a third.
[[nodiscard]] std::vector<std::string> problems_on_all_grids();

/// Whole solves from the problem's own guess, with one stage.
///
/// The program is made anew by every repetition. So making it is measured as often as solving it, where its arrays lie
/// is part of the noise that the repetitions tell, and no program of a million intervals, a gigabyte, waits for its
/// turn.
class SolveBenchmark {
 public:
  explicit SolveBenchmark(SolveName name);

  /// Every turn is one solve; the structure that a solver finds in the program is part of it; the trace, its
  /// derivatives and judging the answer are not.
  void run(benchmark::State& state);

 private:
  /// Of a solve of its own, which is not timed: handing back memory to the system makes the next solve slower.
  [[nodiscard]] std::optional<double> peak_bytes() const;

  SolveName name_;
  std::unique_ptr<Problem> problem_;
  bool is_memory_known_ = false;
  std::optional<double> bytes_;
};

}  // namespace dmocbench::speed
