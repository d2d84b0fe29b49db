#pragma once

#include <string>
#include <vector>

#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The largest excess over a bound or a path constraint, relative to its scale.
struct MotionViolation {
  /// Relative to the constraint's scale; infinite where h is not a number. See `is_priced`.
  double share = 0.0;
  double size = 0.0;       ///< the same in the unit of the constraint
  std::string constraint;  ///< "path_constraints[0]", "bounds().v: the velocity of q[1] (y)"; empty without violation
  bool is_bound = false;   ///< of a coordinate, velocity or control, not a path constraint
  /// Whether `share` is `share_per_added_cost` times what all excesses would add to the least cost, as a share of it.
  bool is_priced = false;
  Eigen::Index interval = 0;  ///< k
  double time = 0.0;          ///< in [t_k, t_{k+1}]
};

/// Violations of a motion between the points of a transcription, which imposes bounds on q at nodes and bounds on q̇ and
/// u and h >= 0 at stages only.
struct ViolationBetweenStages {
  MotionViolation state;    ///< of the bounds on q and q̇ and of h >= 0
  MotionViolation control;  ///< of the bounds on u
  double missed = 0.0;      ///< by the motion whose controls are clipped to their bounds, relative to its range
  double largest = 0.0;     ///< the largest size of all violations, each in its own unit
  /// Where a control leaves its bounds by more than `largest_violation_of_a_motion`, in rising order.
  std::vector<Eigen::Index> intervals_of_control = {};

  /// Whether q, q̇ and h leave their bounds by no more than `largest_violation_of_a_motion`.
  [[nodiscard]] bool keeps_state() const;
  /// Whether u does, or the motion misses no more than `smallest_miss` without the excess.
  [[nodiscard]] bool keeps_controls() const;
  /// Whether both hold.
  [[nodiscard]] bool is_motion() const { return keeps_state() && keeps_controls(); }
  /// Sentences for an answer that is not a motion: which constraint it leaves, by how much, when, and what can be
  /// done.
  [[nodiscard]] std::string words(const Problem& problem, const Trajectory& trajectory) const;
};

/// Measures the element's polynomial of q with its time derivative, and the stage polynomial of u, at nine points per
/// interval, both ends among them; with one stage q̇ passes through both nodes and the stage. Violations up to 1e-8 of
/// the range, or of 1 if that is more, count as rounding. Of every path constraint it finds the worst violation, to 1 %
/// or 1e-9, or less in tiny units: parts of intervals are halved until the ranges of h_i and of its rate
/// (`EnclosedRate`) leave no room for a worse one between their ends. So no obstacle is too thin or too flat around to
/// be seen.
///
/// The scale of a bound is the range of its component along the motion; the range of all components of q, or of q̇,
/// where it is constant. The share of a path constraint is δ |h_i| / D_i at its least value, where D_i adds up by how
/// much h_i changes at most when each entry of (q, q̇, u) moves by ± δ of its range, δ =
/// `largest_violation_of_a_motion`: the share is above δ exactly where such displacements do not make up for the
/// violation, also where ∂h_i vanishes. It is at least the share of the largest bound of h_i, if that is not 0. As an
/// obstacle may be thinner than these displacements, a share of at most δ is replaced by its depth's, |h_i| /
/// (|h_i| + E_i), if that is above `largest_share_of_depth`. E_i adds up by how much h_i falls further at most when
/// each entry moves by ± 4δ of its range or less; where h_i is linear this replaces nothing. So that the depth does not
/// depend on the formula of the obstacle, log(r²) or 1/r², it is at least 2 p / (p + o), least over the entries that
/// displacements of p and o to either side take out of it. A share of at most δ is 1 if no single displacement makes up
/// for the violation and all together, each by δ, do not either: next to a pole of h_i its changes are large without
/// effect.
///
/// A motion that has to leave a bound on q, q̇ or y, or a path constraint, whatever its control, may do so between two
/// points where it is imposed; a free horizon then grows until these are far enough apart, however many intervals there
/// are. Prices times excesses show it: their sum is by how much the least cost would grow, to first order, if the
/// bounds held between their points. The excess of an interval is the largest one along the cubic polynomials through
/// (q, q̇, y) and their rates at both nodes, by the equations of motion; by one stage the element's q is linear. The sum
/// takes the place of `state` where its share is larger.
///
/// A polynomial through the stages overshoots the bounds of u wherever a control switches or has a kink. The share of
/// the controls is the largest mean excess |u - clipped u| of a component in an interval, relative to its range: a
/// kink's falls with the step, a jump's does not. Every interval with an excess is replayed with the clipped
/// control, to first order in the clipped part: δq̇ = ∫ L_vv⁻¹ (f(u) - f(clipped u)) dt,
/// δq = ∫ (t_{k+1} - t) L_vv⁻¹ (f(u) - f(clipped u)) dt. `missed` is the sum of their misses, each the larger one of
/// |δq| and |δq̇|, relative to the ranges of q and q̇ (`Accuracy`); it falls with the step.
[[nodiscard]] ViolationBetweenStages violation_between_stages(const Problem& problem, const TracedProblem& traced,
                                                              const Trajectory& trajectory);

/// The largest share of its scale by which a motion may leave a bound or path constraint. Above it the discrete program
/// is solved, but its answer is not a trustworthy motion: `Status::violates_between_stages`.
inline constexpr double largest_violation_of_a_motion = 0.005;

/// The share of `MotionViolation::is_priced` per share of the cost, so that a motion may save 1.5 % of the cost by its
/// excesses. On all problems by DMOC, Hamiltonian and tangent-space collocation with one and two stages on 16 to 128
/// intervals motions save at most 0.3 %; where a start overshoots a bound by 0.1 % or more of it, and the cost is wrong
/// by 5 % or more, at least 1.8 %.
inline constexpr double share_per_added_cost = largest_violation_of_a_motion / 0.015;

/// The largest share of the depth of an obstacle that a motion may enter, however thin it is.
inline constexpr double largest_share_of_depth = 0.2;

/// The permitted miss of a motion with clipped controls, however far they exceed their bounds. It is small because an
/// optimum makes use of every excess, which then acts on the motion until its end.
inline constexpr double smallest_miss = 3e-5;

}  // namespace dmocbench
