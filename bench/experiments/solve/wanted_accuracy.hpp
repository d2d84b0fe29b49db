#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/run/experiment.hpp"
#include "methods/adaptive/adaptive_solve.hpp"

namespace dmocbench {

/// Solves a case on grids that are refined until the estimated error is at most `options.accuracy`. The case is then
/// the one on the last grid, its stages included, and counts and times are the sums over all grids. Where the accuracy
/// is not reached, the status is not a solved one, and the message gives the reason. `on_grid` as `solve_adaptively`,
/// which also throws `Error`.
[[nodiscard]] SolvedCase solve_accurately(Case the_case, const Start& start, const AdaptiveOptions& options,
                                          const std::function<void(const GridAttempt&)>& on_grid = nullptr);

/// The options --accuracy and --refine: one case is refined grid by grid until its estimated error is small enough.
class WantedAccuracy {
 public:
  /// Registers the options.
  void add_to(CommandLine& line);
  /// Whether --accuracy was given.
  [[nodiscard]] bool is_wanted() const noexcept { return !accuracy_.empty(); }
  /// Reads the options. Throws `Error` if they do not fit each other or the cases.
  void check(const std::vector<Case>& cases);
  /// Solves the case accurately (`solve_accurately`).
  [[nodiscard]] SolvedCase solve(SolveTask task);
  /// A row for every grid of that solve.
  [[nodiscard]] const Table& grids() const noexcept { return grids_; }

 private:
  void note(const GridAttempt& grid, const Case& the_case);

  std::string accuracy_;  // empty: one grid
  std::string refine_;
  AdaptiveOptions adaptive_;
  Table grids_{{"grid", "N", "stages", "estimated error", "largest step", "smallest step", "iterations", "seconds"}};
};

}  // namespace dmocbench
