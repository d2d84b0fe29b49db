#pragma once

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/trajectory.hpp"

namespace dmocbench {

/// Largest difference, over the nodes that both have, of the controls u(x_k, ψ_k) that the maximum principle gives from
/// each trajectory's own state and costate: what has the full order at the nodes, where stage controls have less. 0 if
/// they share no node. Throws `Error` without costates.
[[nodiscard]] double node_control_error(const Problem& problem, const Trajectory& trajectory,
                                        const Trajectory& reference);

}  // namespace dmocbench
