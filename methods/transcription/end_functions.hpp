#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/bounds.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/derivatives/local_functions.hpp"
#include "methods/transcription/elements/element.hpp"

namespace dmocbench {

/// Components of an end that are given and that constraints imply too: stated twice, they would leave the
/// rows of the program dependent. They are not fixed; the rows of the constraints determine them.
struct ReleasedComponents {
  std::vector<Eigen::Index> q;            ///< of the configuration
  std::vector<Eigen::Index> second = {};  ///< of v, or of p where that is fixed (Hamiltonian)
};

/// How the two ends of the horizon enter a program.
///
/// An end is clamped if its whole state is given, and with it its momentum, which is then a number: it is not where L_v
/// depends on an unknown parameter, or on a first-order state that is not given there. At any other end, DMOC and
/// Hamiltonian collocation have the velocity as a further unknown, tied to the momentum by p = L_v(q, v); nothing else
/// changes. Tangent-space collocation has that unknown at every node.
///
/// Every interval states the holonomic constraints of its right node, so that the last interval's hold at T, and so do
/// velocity constraints of nodes that have a p or v. A given q_N is consistent with velocity constraints in any case.
struct EndRules {
  NodeState node_state = NodeState::configuration;  ///< the second part of the nodes' states
  double cost_scale = 1.0;                          ///< factor of the cost
  bool first_clamped = true;                        ///< the state of the first end is given completely
  bool last_clamped = true;                         ///< the state of the last end is given completely
  bool mayer = false;                               ///< the cost is the last z of the Mayer form
  bool free_horizon = false;                        ///< T is an unknown
  Eigen::Index constraints = 0;                     ///< how many constraints there are: c
  ReleasedComponents released_at_first = {};        ///< where the first end is not clamped
  ReleasedComponents released_at_last = {};         ///< at the last end

  /// Whether the first end has rows of constraints, g(q_0) and G v_0: unless its state is given.
  [[nodiscard]] bool has_first_constraints() const noexcept { return constraints > 0 && !first_clamped; }
  /// The same of the last end, without the rows of the last interval: DMOC's G v_N where that velocity is an unknown.
  [[nodiscard]] bool has_last_constraints() const noexcept {
    return constraints > 0 && carries_q_alone() && !last_clamped;
  }
  /// How many multipliers node N has that belong to no interval: DMOC's λ_N.
  [[nodiscard]] Eigen::Index last_multipliers() const noexcept { return carries_q_alone() ? constraints : 0; }
  /// True if the velocity of the first (last) end is an unknown in addition to its node's.
  [[nodiscard]] bool first_has_velocity() const noexcept { return !first_clamped && node_state != NodeState::velocity; }
  /// True if the velocity of the last end is an unknown of its own.
  [[nodiscard]] bool last_has_velocity() const noexcept { return !last_clamped && node_state != NodeState::velocity; }
  /// True of DMOC.
  [[nodiscard]] bool carries_q_alone() const noexcept { return node_state == NodeState::configuration; }
};

/// The rules for a problem and a family of elements. Tangent-space ends count as clamped where their state is fixed.
[[nodiscard]] EndRules end_rules(const Problem& problem, const TracedProblem& traced, NodeState node_state, bool mayer);

/// The functions of both ends of the horizon, traced and differentiated once.
///
/// Local unknowns, for the first end and then for the last: q, p (Hamiltonian), y, v where it is an unknown
/// (tangent-space: q, v, y); then z_N in
/// Mayer form; T where it is free; unknown parameters. Cost: Φ, in Mayer form z_N + Φ. Local constraints (rows): per
/// end whose velocity is an unknown, ±L_v(q, v), added to the equation of the node (DMOC), or p - L_v(q, v) = 0
/// (Hamiltonian); -Gᵀλ_N joins DMOC's equation of node N, where that multiplier is the last unknown of the end; then
/// g(q_0), G v_0 and G v_N, where `EndRules` requires them; then the
/// boundary conditions r = 0 (eq:gDLOCP6).
struct EndFunctions : LocalFunctions {
  Eigen::Index ties = 0;        ///< equations that tie velocities to momenta, and the equations of λ_N
  Eigen::Index conditions = 0;  ///< boundary conditions
};

/// Nothing if the ends are clamped and no formula depends on them.
[[nodiscard]] std::optional<EndFunctions> trace_ends(const Problem& problem, const TracedProblem& closed,
                                                     const EndRules& rules);

/// Throws `Error` that names a path constraint which the ends alone break: one that reads no control and no component
/// of q, v or T that is left free there, and is negative by more than rounding.
///
/// Programs have h >= 0 at stages only (eq:gDLOCP5), so that none of their constraints would show it; yet no motion
/// with such an end satisfies h >= 0. `horizon` is the time of the last end, where it is fixed.
void require_path_constraints_at_ends(const Problem& problem, const TracedProblem& traced, const ProblemBounds& bounds,
                                      double horizon);

/// Throws `Error` that reports by how much an end whose configuration is given leaves the constraints g(q) = 0, or one
/// whose velocity is given too leaves G v = 0 or A v = 0.
void require_motion_constraints_at_ends(const Problem& problem, const TracedProblem& traced,
                                        const ProblemBounds& bounds);

}  // namespace dmocbench
