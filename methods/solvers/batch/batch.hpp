#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include <Eigen/Core>

namespace dmocbench {

/// One instance of a program: the same structure, other numbers.
struct BatchInstance {
  /// The start of the solve, variable_count() entries. Fixed unknowns have these values in this
  /// instance (the states of clamped ends, `ClampedEnds`).
  Eigen::VectorXd start;
  /// The values of equalities, constraint_count() entries; none for the program's.
  Eigen::VectorXd equality_values;
  /// λ of an instance that is nearly the same, constraint_count() entries: a warm start. None for a cold one.
  Eigen::VectorXd multipliers;
  /// `LaneProgram::parameter_count` entries; none for the program's.
  Eigen::VectorXd parameters;
};

/// Options of a batch, with the same meaning as in `SolverOptions`.
struct BatchOptions {
  double tolerance = 1e-10;   ///< for the KKT residual of the scaled program
  int most_iterations = 500;  ///< of an instance
  /// Instances that the lanes cannot finish are solved one by one by `interior_point`; if false they keep the status
  /// "step failed".
  bool falls_back = true;
  /// The number of threads that share the instances; 0 for `thread_count()`.
  std::size_t threads = 0;
  /// Called once per iteration; true ends the batch: instances that are not finished are "interrupted", and no others
  /// are fetched.
  std::function<bool()> stop_requested = {};
  /// Wall clock for the batch, 0 for no limit; the time of the caller's `StopScope` is a limit too. Then it ends alike,
  /// with the status "time limit".
  double most_seconds = 0.0;
  /// Gives the program that evaluates single solves the parameters of an instance; needed where there are any.
  std::function<void(const Eigen::VectorXd& parameters)> set_parameters = {};
};

/// The phases of a batch.
enum class BatchPhase : std::uint8_t {
  tapes,           ///< values and derivatives of the program
  linear_systems,  ///< assembling and solving them
  line_search,     ///< the rest of the search for a step's length
  one_by_one,      ///< instances that lanes cannot finish, and waiting for the program that they share
  exchange,        ///< fetching instances and delivering answers
  rest,            ///< judging iterates
};
/// The number of phases.
inline constexpr std::size_t batch_phases = 6;
/// Seconds by phase.
using BatchSeconds = std::array<double, batch_phases>;

/// The result of a batch.
struct BatchSummary {
  std::size_t instances = 0;  ///< how many were given
  std::size_t solved = 0;     ///< how many of them were solved
  /// Finished by `interior_point`, because lanes restore feasibility in the simplest way only, and have no sparse
  /// factorisation.
  std::size_t solved_one_by_one = 0;
  /// Iterations of eight lanes together; all instances' iterations, divided by eight times this, give the share of busy
  /// lanes.
  std::size_t rounds = 0;
  /// Seconds of all threads together.
  BatchSeconds seconds{};
};

}  // namespace dmocbench
