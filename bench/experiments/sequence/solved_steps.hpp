#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "bench/experiments/sequence/neighbours.hpp"
#include "bench/run/solve_case.hpp"
#include "methods/program/interval_structure.hpp"
#include "methods/solvers/prepared_solve.hpp"
#include "methods/tables/table.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The motion of a horizon that has moved on by the first interval of its grid: q(t + h), carried on beyond its end by
/// the velocity that it has there.
[[nodiscard]] Motion one_interval_later(const Trajectory& trajectory);

/// Multipliers of a problem that has moved on by one interval of a uniform grid: values of node or interval k + 1 move
/// to k. The last node and interval keep their values, as do places at one end and of the whole horizon. `values` has
/// an entry per place.
[[nodiscard]] Eigen::VectorXd shifted(const Places& places, const Eigen::VectorXd& values);

/// One solve of a step.
struct StepSolve {
  std::string status;
  int iterations = 0;
  double microseconds = 0.0;  ///< of the solver alone, the smallest of the repeats
};

/// A step of a sequence.
struct SequenceStep {
  Scheme scheme;
  std::size_t intervals = 0;
  std::string sequence;
  int number = 0;
  StepSolve warm;  ///< from the motion, multipliers and barrier parameter of the last step
  std::optional<double> start_barrier_parameter = std::nullopt;  ///< of the warm solve, where the problem has a barrier
  std::optional<StepSolve> cold = std::nullopt;                  ///< from the problem's guess, if requested
  std::optional<double> objective = std::nullopt;

  /// Whether the cold start did better: it was solved and the warm one was not, or in fewer iterations.
  [[nodiscard]] std::optional<bool> is_warm_worse() const;
};

/// One method on its way through a sequence.
class SequenceRun {
 public:
  /// `solved`: the first problem's case with its answer. A step is solved `repeats` times; its time is the shortest.
  SequenceRun(const SolvedCase& solved, std::unique_ptr<Neighbours> neighbours, const SolverOptions& options,
              int repeats);

  /// Solves the next problem warm, and cold if requested or if the warm start fails. If both fail, the sequence ends.
  [[nodiscard]] SequenceStep next(bool also_cold);
  [[nodiscard]] bool is_at_end() const noexcept { return is_at_end_; }

 private:
  /// The last motion, moved to the next problem's ends. Moves the multipliers with it.
  [[nodiscard]] Eigen::VectorXd warm_start();
  void go_on_from(const Solution& answer);

  Case case_;
  std::unique_ptr<Neighbours> neighbours_;
  int repeats_;
  int step_ = 0;
  bool is_at_end_ = false;
  std::unique_ptr<Transcription> program_;  // made once; its values change from step to step
  std::unique_ptr<PreparedSolve> prepared_;
  Trajectory trajectory_;
  Eigen::VectorXd multipliers_;
  std::optional<double> barrier_parameter_;  // with which the last solve ended; empty if there is no barrier
};

/// A row per step.
[[nodiscard]] Table step_table(const std::vector<SequenceStep>& steps);
/// A row per method and sequence: how many steps were solved, the median, the 99th percentile and the largest number of
/// iterations and of microseconds of a warm step, the medians of cold ones, the share of steps where warm was worse.
[[nodiscard]] Table sequence_summary(const std::vector<SequenceStep>& steps);

}  // namespace dmocbench
