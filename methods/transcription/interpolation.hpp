#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "methods/mechanics/state.hpp"
#include "methods/transcription/trajectory.hpp"

namespace dmocbench {

/// A motion given for every time 0 <= t <= T: where starts are sampled from.
struct Motion {
  std::function<MotionPoint(double t)> at;
  double horizon = 0.0;  ///< its own T > 0
};

/// The node of ascending `times` at time t, up to rounding; none if there is no such node.
[[nodiscard]] std::optional<Eigen::Index> node_at(const Eigen::VectorXd& times, double t);

/// The element's own polynomial of the configuration at time t: q(t_k + τh) = q_k + h Σ_j Q̇_j ∫₀^τ ℓ_j, n entries.
/// Times outside the horizon are moved to its ends.
[[nodiscard]] Eigen::VectorXd configuration_at(const Trajectory& trajectory, double t);

/// From which side a time is approached: controls may jump at the nodes.
enum class Side : std::uint8_t { left, right };

/// The control at time t, m entries: with one stage, linear between the two nearest stage times (order 2; beyond the
/// first and last of them the same line goes on); with several, the polynomial through the stages of the interval, at a
/// node of the one on that side.
[[nodiscard]] Eigen::VectorXd control_at(const Trajectory& trajectory, double t, Side side = Side::right);

/// The control as the discrete system feels it: the polynomial through the stages of the interval [t_k, t_{k+1}] that
/// `interval` names, constant for one stage.
[[nodiscard]] Eigen::VectorXd control_on_interval(const Trajectory& trajectory, Eigen::Index interval, double t);

/// The slope of the element's own polynomial of the configuration in the interval that `interval` names, n entries.
[[nodiscard]] Eigen::VectorXd velocity_on_interval(const Trajectory& trajectory, Eigen::Index interval, double t);

/// The motion as a smooth curve: piecewise cubic Hermite in (q, v), its derivative as velocity, `control_at` as
/// control.
[[nodiscard]] Motion smooth_motion(const Trajectory& trajectory);

}  // namespace dmocbench
