#pragma once

#include <string>
#include <vector>

#include "bench/run/experiment.hpp"
#include "methods/adaptive/adaptive_solve.hpp"

namespace dmocbench {

/// The options --accuracy and --refine: one case is refined grid by grid until its estimated error is small enough.
class WantedAccuracy {
 public:
  /// Registers the options.
  void add_to(CommandLine& line);
  /// Whether --accuracy was given.
  [[nodiscard]] bool is_wanted() const noexcept { return !accuracy_.empty(); }
  /// Reads the options. Throws `Error` if they do not fit each other or the cases.
  void check(const std::vector<Case>& cases);
  /// Finds the grid and solves the case on it, from the answer there; prints a line for every grid. The case, its
  /// stages included, is then the one on that grid, with its estimated error. Throws `NoStart` if no grid is fine
  /// enough, or the time is up before.
  [[nodiscard]] SolvedCase solve(SolveTask task);

 private:
  std::string accuracy_;  // empty: one grid
  std::string refine_;
  AdaptiveOptions adaptive_;
};

}  // namespace dmocbench
