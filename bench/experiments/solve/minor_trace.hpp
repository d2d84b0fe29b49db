#pragma once

#include <string>
#include <vector>

#include "bench/run/experiment.hpp"
#include "methods/solvers/sqp/sqp_solver.hpp"

namespace dmocbench {

/// The option --trace: a file with a row for every minor iteration of one solve by sqp.
class MinorTrace {
 public:
  /// Registers the option.
  void add_to(CommandLine& line);
  /// Whether the option was given.
  [[nodiscard]] bool is_wanted() const noexcept { return !file_.empty(); }
  /// Throws `Error` unless a single case is solved by sqp, and the file can be written and is not one of the run's.
  void check(const std::vector<Case>& cases, const ExperimentCard& card) const;
  /// Solves the case and keeps its minor iterations, of the last solve if it is repeated.
  [[nodiscard]] SolvedCase solve(const SolveTask& task);
  /// Writes the file. Throws `Error` if that fails.
  void write(const SolvedCase& solved);
  /// Adds the file to the metadata of the run if it is in the run's folder.
  void describe(FurtherOutput& output) const;

 private:
  std::string file_;
  std::vector<MinorIteration> minors_;
  Table table_;  // as it was written
};

}  // namespace dmocbench
