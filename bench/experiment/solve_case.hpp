#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiment/case.hpp"
#include "bench/experiment/column.hpp"
#include "methods/program/solution.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/interpolation.hpp"
#include "methods/transcription/trajectory.hpp"

namespace dmocbench {

/// Everything an experiment may want to know of one solve.
struct SolvedCase {
  Case the_case;
  std::shared_ptr<Transcription> program = nullptr;  ///< null if the case could not start
  Solution solution = {};
  Eigen::VectorXd start = {};                           ///< the point it began at; empty if there was none
  std::optional<Trajectory> trajectory = std::nullopt;  ///< none if there is no point, or one without momenta
  std::string branch = {};  ///< "same" or "other" than that of the start; empty if nobody can tell
  std::optional<double> setup_seconds = std::nullopt;
  std::optional<double> smallest_seconds = std::nullopt;  ///< of several solves
  std::optional<int> polish_steps = std::nullopt;         ///< none if the answer was not to be polished

  /// Adds a sentence to the message of the row.
  void note(const std::string& sentence) { solution.message += " " + sentence; }
};

/// The columns that begin every experiment's table.
[[nodiscard]] const Columns<SolvedCase>& core_columns();

/// Where a solve starts, and the motion that tells whether its answer is on the wanted branch; without
/// one the branch is left open.
struct Start {
  Motion motion;
  std::optional<Motion> branch;
};

/// Transcribes, samples the start, solves `repeats` times (times are medians) and reads the trajectory. A failure is
/// part of the result; its message names what the point misses most. The solver sees the case's derivatives; residuals
/// and status are those of the exact ones whatever they are, so that wrong derivatives cannot confirm themselves.
/// Throws `Error` on misuse only. With `polishes` the answer is tightened by Newton steps, which no time counts.
[[nodiscard]] SolvedCase solve_case(const Case& the_case, const Start& start, const SolverOptions& options, int repeats,
                                    bool polishes = false);
/// The same by another solver than the one of the case's name.
[[nodiscard]] SolvedCase solve_case(const Case& the_case, const Start& start, const Solver& solver, double tolerance,
                                    int repeats, bool polishes);

/// Replaces the times of a solve by the medians of several.
void set_median_times(SolvedCase& solved, const std::vector<Solution>& repeats);

/// A case that could not start: status "not run", the reason as its message.
[[nodiscard]] SolvedCase unsolved_case(const Case& the_case, const std::string& reason);

/// True if no node is a tenth of the range of q or more away from the motion, at the same relative time.
[[nodiscard]] bool is_on_branch(const Trajectory& trajectory, const Motion& branch);

/// True of solves that were answered on the wanted branch: what curves, orders and claims are made of.
[[nodiscard]] bool is_usable(const SolvedCase& solved);
[[nodiscard]] bool is_usable(const Row& row);

}  // namespace dmocbench
