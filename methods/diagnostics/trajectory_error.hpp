#pragma once

#include <optional>

#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// Largest differences at the stages, Euclidean norm.
struct StageError {
  double configuration = 0.0;            ///< of Q_i
  double momentum = 0.0;                 ///< of P_i
  std::optional<double> costate_q = {};  ///< of Ψ^q_i; none without multipliers
  std::optional<double> costate_p = {};  ///< of Ψ^p_i
};

/// Largest differences between a trajectory and a reference, Euclidean norm as in section 4.2 of the paper.
struct TrajectoryError {
  double state = 0.0;     ///< max over the nodes of |q(t_k) - q_ref(t_k)|
  double momentum = 0.0;  ///< max over the nodes of |p(t_k) - p_ref(t_k)|; nodes that the reference lacks are left out
  double control = 0.0;   ///< max over the stages of |u - u_ref| at the stage times
  std::optional<double> costate;  ///< max over the nodes of |ψ - ψ_ref|, ψ = (ψ_q, ψ_p); none without multipliers
  std::optional<double> first_order;          ///< the same of y; none without first-order states
  std::optional<double> first_order_costate;  ///< the same of ψ_y; none without them or without multipliers
  double objective = 0.0;                     ///< |J - J_ref|
  /// Present only if the reference is given at the same stage times: stage values have an order of their own, which
  /// interpolation between other stages would hide.
  std::optional<StageError> stages;
};

/// Errors against a reference on a finer grid. Controls are compared at the stage times of the coarse grid, where
/// `reference_control_at` evaluates the reference; motions with different horizons at the same relative times. At nodes
/// that the reference lacks, `configuration_at` evaluates its configuration.
[[nodiscard]] TrajectoryError trajectory_error(const Trajectory& trajectory, const Trajectory& reference);

}  // namespace dmocbench
