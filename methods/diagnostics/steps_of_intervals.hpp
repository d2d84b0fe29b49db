#pragma once

#include <memory>

#include <Eigen/Core>

#include "methods/expression/tape.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// Integrates the equations of motion over many intervals at once, each from its first node on under its own controls,
/// by a single step of the method of `integrate`. For problems without constraints of the motion.
class StepsOfIntervals {
 public:
  /// Traces the equations of motion, solved for the accelerations without an exchange of rows (`solve_symmetric`).
  /// Throws `Error` if a pivot of L_vv is a structural zero.
  explicit StepsOfIntervals(const TracedProblem& traced);

  /// (q, v, y) where the intervals `first` to `first` + `count` - 1 end, a column each; not a number where `integrate`
  /// would not accept the step. Threads may share the object.
  [[nodiscard]] Eigen::MatrixXd ends(const Trajectory& trajectory, Eigen::Index first, Eigen::Index count,
                                     double tolerance) const;

 private:
  Tape tape_;  // inputs q, v, u, y, t and h, outputs h times the rates of q, v and y
};

}  // namespace dmocbench
