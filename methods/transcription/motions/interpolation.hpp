#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/state.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// A motion given for every time 0 <= t <= T; starts are sampled from it.
struct Motion {
  std::function<MotionPoint(double t)> at;  ///< (q, v, u, y) at a time
  double horizon = 0.0;                     ///< T > 0
  Eigen::VectorXd unknowns = {};            ///< unknown parameters; empty for the problem's values
};

/// The node of ascending `times` at time t, up to rounding; none if there is no such node.
[[nodiscard]] std::optional<Eigen::Index> node_at(const Eigen::VectorXd& times, double t);

/// The element's polynomial of the configuration at time t: q(t_k + τh) = q_k + h Σ_j Q̇_j ∫₀^τ ℓ_j, n entries.
/// Times outside the horizon are moved to its ends.
[[nodiscard]] Eigen::VectorXd configuration_at(const Trajectory& trajectory, double t);

/// The side from which a time is approached: controls may jump at the nodes.
enum class Side : std::uint8_t { left, right };

/// The control at time t, m entries. With one stage it is linear between the two nearest stage times (order 2), and is
/// extrapolated beyond the first and the last of them. With several stages it is the polynomial through the stages of
/// the interval; at a node, of the interval on that side.
[[nodiscard]] Eigen::VectorXd control_at(const Trajectory& trajectory, double t, Side side = Side::right);

/// The control of a reference at time t, m entries: the polynomial through the stages of the interval on that side and
/// the nearest stage of each neighbouring interval, of order s + 2, or s + 1 in the first and last interval. Errors
/// against it are errors of stage values. The polynomial through the stages of one interval has only the order s.
[[nodiscard]] Eigen::VectorXd reference_control_at(const Trajectory& trajectory, double t, Side side = Side::right);

/// The control that acts on the discrete system: the polynomial through the stages of interval k = `interval`,
/// [t_k, t_{k+1}]; constant for one stage.
[[nodiscard]] Eigen::VectorXd control_on_interval(const Trajectory& trajectory, Eigen::Index interval, double t);

/// The time derivative of the element's polynomial of the configuration in interval k = `interval`, n entries.
[[nodiscard]] Eigen::VectorXd velocity_on_interval(const Trajectory& trajectory, Eigen::Index interval, double t);

/// The element's polynomial of first-order states in interval k = `interval`, l entries: y_k + h Σ_j Ẏ_j ∫₀^τ ℓ_j.
[[nodiscard]] Eigen::VectorXd first_order_on_interval(const Trajectory& trajectory, Eigen::Index interval, double t);

/// The motion as a smooth curve: piecewise cubic Hermite in (q, v), its derivative as velocity, `control_at` as
/// control; first-order states linear between the nodes.
[[nodiscard]] Motion smooth_motion(const Trajectory& trajectory);

/// A motion with sines added that vanish at both ends of its horizon T: q gains Σ_k a_k sin((k + 1) π t / T), where a_k
/// is column k = 0, 1, ... of `amplitudes` (n rows, in the units of q), and v the derivative. The control gains
/// Σ_k b_k cos(k π t / T), with b_k the columns of `of_control` (m rows, in the units of u, or none: then it stays).
[[nodiscard]] Motion bent(const Motion& motion, const Eigen::MatrixXd& amplitudes,
                          const Eigen::MatrixXd& of_control = {});

/// A motion moved to the states that `bounds` fix at the ends of its horizon, by the cubic polynomial in time that has
/// the missing q and v there; free entries of an end are not moved. Controls stay.
///
/// The start of a program from the answer of a neighbour with other ends. Where only its end nodes are moved, the
/// displacement δ occurs in one interval, whose mean velocity is wrong by δ/h, more than the motion itself may be
/// fast: methods that have no velocities among their unknowns (DMOC, and Hamiltonian collocation by p = L_v) then start
/// far from where their equations are linear.
[[nodiscard]] Motion moved_to_ends(const Motion& motion, const ProblemBounds& bounds);

}  // namespace dmocbench
