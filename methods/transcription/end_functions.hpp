#pragma once

#include <optional>

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/element.hpp"
#include "methods/transcription/local_functions.hpp"

namespace dmocbench {

/// How the two ends of the horizon enter a program.
///
/// An end is clamped if its whole state is given, so that its momentum is a number. At any other end of DMOC and of
/// Hamiltonian collocation the velocity is a further unknown, tied to the momentum by p = L_v(q, v): nothing else
/// changes. Tangent-space collocation has that unknown at its nodes anyway.
struct EndRules {
  NodeState node_state = NodeState::configuration;
  double cost_scale = 1.0;
  bool first_clamped = true;
  bool last_clamped = true;
  bool mayer = false;
  bool free_horizon = false;

  /// True if the velocity of the first, or last, end is an unknown beside those of its node.
  [[nodiscard]] bool first_has_velocity() const noexcept { return !first_clamped && node_state != NodeState::velocity; }
  [[nodiscard]] bool last_has_velocity() const noexcept { return !last_clamped && node_state != NodeState::velocity; }
};

/// What the rules are for a problem and a family. Tangent-space ends count as clamped where their state is fixed.
[[nodiscard]] EndRules end_rules(const Problem& problem, const TracedProblem& traced, NodeState node_state, bool mayer);

/// The part of a program that its ends make.
///
/// Local unknowns, for the first end and then for the last: q, p (Hamiltonian), v where it is an unknown; then z_N in
/// Mayer form; T where it is free. Cost: Φ, in Mayer form z_N + Φ. Local rows: per end with a velocity of its own
/// ±L_v(q, v) to the row of the node (DMOC) or p - L_v(q, v) = 0 (Hamiltonian); then the boundary conditions r = 0.
struct EndFunctions : LocalFunctions {
  Eigen::Index ties = 0;        ///< rows that tie velocities to momenta
  Eigen::Index conditions = 0;  ///< boundary conditions
};

/// None if the ends are clamped and nothing depends on them.
[[nodiscard]] std::optional<EndFunctions> trace_ends(const Problem& problem, const TracedProblem& traced,
                                                     const EndRules& rules);

}  // namespace dmocbench
