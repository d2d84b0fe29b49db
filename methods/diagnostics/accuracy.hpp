#pragma once

#include <string>

#include <Eigen/Core>

#include "methods/mechanics/bounds.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The jumps of a motion whose intervals are replayed one by one: how far the continuous system, started at node k
/// under the controls of interval k, ends from node k + 1. Unlike the replay of the whole horizon (`ReplayError`) they
/// judge unstable systems too, where an error of any size grows without bound until the end.
struct Accuracy {
  double jump = 0.0;           ///< |(q, v)(t_{k+1}) - (q_{k+1}, v_{k+1})|, the largest over k
  double relative_jump = 0.0;  ///< the largest |Δq| / range of q, |Δv| / range of v or |Δy| / range of y
  Eigen::Index interval = 0;   ///< k where `relative_jump` is
  /// The same of the sum of the jumps of intervals 0 to k, with their signs, the largest over k. A force whose period
  /// is the step is sampled at one phase: no interval misses by much, but all miss to the same side.
  double accumulated_jump = 0.0;
  Eigen::VectorXd missed = {};  ///< |sum of jumps|, the largest over k, of every entry of (q, v, y), each in its unit
  /// |∫C dt - Σ h b_i C_i| along the elements' polynomials, the error of the program's quadrature by one of order 14,
  /// as a share of Σ_k |∫C dt over interval k|, of the whole cost, or of 1e-6, whichever is most. A cost that
  /// oscillates as fast as the grid is sampled at one phase.
  double cost_error = 0.0;
  /// |∫C dt - Σ h b_i C_i + Σ ψ_{k+1}·δx_k| as the same share, δx_k the jumps in (q, p, y): to first order, the error
  /// of the least cost. A force that oscillates as fast as the grid changes the cost although no interval misses by
  /// much. Without costates, or with constraints on q, it is `cost_error`.
  double cost_miss = 0.0;
  /// `control_saving` as the same share: what controls that vary within the intervals would save. The price of a
  /// control may oscillate so that the quadrature is right on average, but a control that follows it is much cheaper.
  double control_saving = 0.0;

  /// Whether no jump, their sum, an error of the cost or a saving is too large for a motion.
  [[nodiscard]] bool is_motion() const;
};

/// Replays every interval with the control polynomial through its stages, on the continuous forced Euler-Lagrange
/// equations (eq:varmech_FEL), by an adaptive Runge-Kutta method of order 7(8) with the given tolerance, absolute and
/// relative. Independent of every discretisation. All jumps are infinite where the integration of an interval fails.
///
/// Norms are Euclidean. The range of q is the norm of the differences between the largest and the smallest value of
/// each component over the nodes, the range of v likewise. If one of the two is constant the range of the other is
/// taken, and 1 if both are. A range of at most `smallest_range` times max(1, |q|), or max(1, |v|), counts as constant:
/// the movement of a body at rest is rounding, and so are its jumps: a range counts as so large that a jump of that
/// size stays below `largest_jump_of_a_motion`.
///
/// The intervals are shared out to `thread_count()` threads; the result does not depend on their number.
///
/// With one stage the jump is O(h³) on smooth optima, one order more than the error at the nodes. With s > 1 it is
/// between O(h^(s+2)) and O(h^(2s+1)): stage controls have order s + 1 (methods/README.md, "Where the order is").
[[nodiscard]] Accuracy accuracy(const Problem& problem, const Trajectory& trajectory, double tolerance = 1e-12);
/// The same by formulas that are traced already, for the present values of parameters that are kept open.
[[nodiscard]] Accuracy accuracy(const TracedProblem& traced, const Trajectory& trajectory, double tolerance = 1e-12);

/// See `accuracy`.
inline constexpr double smallest_range = 1e-8;

/// The largest `Accuracy::relative_jump` of an answer that is a motion. Above it the discrete program is solved, but
/// discretisation errors dominate its answer: it is `Status::too_coarse`.
inline constexpr double largest_jump_of_a_motion = 0.05;

/// The largest `Accuracy::accumulated_jump` of an answer that is a motion. Right answers stay below it: on 36 problems
/// and a force of 16 to 128 periods by three methods with one and two stages on 16 to 128 intervals none exceeds 0.18.
inline constexpr double largest_accumulated_jump_of_a_motion = 0.2;

/// The largest `Accuracy::cost_error` of an answer that is a motion. On 36 problems by DMOC and tangent-space
/// collocation with one and two stages on 8 to 64 intervals it exceeds 0.041 for costs that are wrong by 40 % only.
inline constexpr double largest_cost_error_of_a_motion = 0.05;

/// The largest `Accuracy::cost_miss` of an answer that is a motion. On all problems by DMOC and tangent-space
/// collocation with one and two stages on 8 to 64 intervals every cost above it is wrong by 12 % or more.
inline constexpr double largest_cost_miss_of_a_motion = 0.12;

/// The largest `Accuracy::control_saving` of an answer that is a motion. On all problems by DMOC, Hamiltonian and
/// tangent-space collocation with one and two stages on 16 to 64 intervals it exceeds 0.09 only where a jump is too
/// large.
inline constexpr double largest_control_saving_of_a_motion = 0.12;

/// The distances that a problem prescribes: of every entry of (q, q̇), the least distance between its largest and its
/// smallest value that both ends and the times between them allow. 0 where an entry may stay the same.
[[nodiscard]] Eigen::VectorXd given_distances(const ProblemBounds& bounds);

/// Whether the tolerance may hide a distance between values of this size: whether it is positive and below
/// `smallest_distance`, of 1 or of the size.
[[nodiscard]] bool is_small_distance(double distance, double size);

/// The same as `given_distances`, but 0 unless it is small next to the largest magnitude of the entry, and above
/// round-off of the largest distance and of the largest |q|.
[[nodiscard]] Eigen::VectorXd small_distances(const ProblemBounds& bounds, const Trajectory& motion);

/// Why an answer that satisfies its program to the tolerance does not cover the given distances; empty where it does.
///
/// Tolerances are absolute: next to one of 1e-8 a body that stays at rest solves the program of a distance of 1e-9. So
/// each of `small_distances` has to show in the motion: what its jumps (`Accuracy::missed`) and its ends miss must not
/// add up to half of it, or of the range of the entry. A missed velocity counts for q times the horizon.
[[nodiscard]] std::string lost_distance(const ProblemBounds& bounds, const Trajectory& motion,
                                        const Accuracy& accuracy);

/// See `is_small_distance`.
inline constexpr double smallest_distance = 1e-6;

}  // namespace dmocbench
