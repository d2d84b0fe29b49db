#pragma once

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The distance from the final state at which the continuous system ends under a trajectory's controls. Components that
/// are not prescribed are taken from the trajectory.
struct ReplayError {
  double configuration = 0.0;  ///< |q(T) - q^T|
  double velocity = 0.0;       ///< |v(T) - v^T|
  double first_order = 0.0;    ///< |y(T) - y^T|
  double cost = 0.0;           ///< the cost of the replayed motion, integrated along with it
  Eigen::VectorXd q = {};      ///< q(T) - q^T, entry by entry: each has its own unit
  Eigen::VectorXd v = {};      ///< v(T) - v^T
  /// Configuration, velocity and first-order states together, Euclidean norm.
  [[nodiscard]] double norm() const;
};

/// Integrates the forced Euler-Lagrange equations (eq:varmech_FEL) from (q⁰, v⁰), where prescribed, with the controls
/// of the trajectory (on every interval the polynomial through its stages), by an adaptive Runge-Kutta method of order
/// 7(8) with the given tolerance, absolute and relative. It is independent of every discretisation. Phases are
/// integrated one after the other, from the state after the switch (`SwitchMap`) to which the phase before has come,
/// and the distance is taken at the end of the last ones. Throws `Error` if the integration fails: the motion leaves
/// the domain of the equations, or the steps vanish.
[[nodiscard]] ReplayError replay_error(const Problem& problem, const Trajectory& trajectory, double tolerance = 1e-12);

/// The cost of a motion whose intervals are replayed one by one, each from its first node, as `accuracy` does, plus Φ
/// at the last node. It exists of unstable motions too. Differs from the cost of the discrete motion to first order in
/// the jumps. Throws `Error` if the integration of an interval fails.
[[nodiscard]] double cost_by_intervals(const Problem& problem, const Trajectory& trajectory, double tolerance = 1e-12);

}  // namespace dmocbench
