#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiment/case.hpp"
#include "bench/experiment/table.hpp"
#include "methods/program/solution.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/interpolation.hpp"
#include "methods/transcription/trajectory.hpp"

namespace dmocbench {

/// Everything an experiment may want to know of one solve.
struct SolvedCase {
  Case what;
  Solution solution;
  Eigen::VectorXd start;                 ///< the point it began at; empty if there was none
  std::optional<Trajectory> trajectory;  ///< none if the solver gave no point, or one where momenta make no sense
  Row row;                               ///< the core columns
};

/// The columns that begin every experiment's table, in this order.
[[nodiscard]] const std::vector<std::string>& core_columns();

/// Where a solve starts, and the motion that tells whether its answer is on the wanted branch; without
/// one the branch is left open.
struct Start {
  Motion motion;
  std::optional<Motion> branch;
};

/// Makes the solver of a case.
using SolverMaker = std::function<std::unique_ptr<Solver>(const Case& of, const SolverOptions& options)>;

/// Transcribes, samples the start, solves `repeats` times (times are medians) and reads the trajectory. A failure is
/// part of the result; its message names what the point misses most. The solver sees the case's derivatives; residuals
/// and status are those of the exact ones whatever they are, so that wrong derivatives cannot confirm themselves.
/// Throws `Error` on misuse only. With `polishes` the answer is tightened by Newton steps (column polish_steps; no time
/// counts them). `make`: instead of `make_solver` by the case's name of a solver.
[[nodiscard]] SolvedCase solve_case(const Case& what, const Start& start, const SolverOptions& options, int repeats,
                                    bool polishes = false, const SolverMaker& make = {});

/// The row of a case that could not even start, with status "not run" and the reason as its message.
[[nodiscard]] SolvedCase unsolved_case(const Case& what, const std::string& reason);

/// The rows of solves that were answered on the wanted branch: what curves, slopes and claims are made of.
[[nodiscard]] bool is_usable(const Row& row);

}  // namespace dmocbench
