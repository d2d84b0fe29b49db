#pragma once

#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// By how much controls that are free at every time would lower the cost of a motion, to first order in the state: the
/// integral of H(u) - H(u + δu) along the elements' polynomials, by a quadrature of order 14, where
/// H = C + ψ_p·f + ψ_y·g, less the prices of integrals and bounds, costates are linear between the nodes, and
/// δu_j = -H_{u_j} / H_{u_j u_j} for the controls in which H is convex. In the units of the cost. 0 without costates,
/// or with constraints of the motion.
///
/// A program whose controls are constant, or polynomials, in each interval cannot follow a price of control that
/// oscillates as fast as the grid: its least cost is right for these controls and may be a multiple of the optimum.
[[nodiscard]] double control_saving(const TracedProblem& traced, const Trajectory& trajectory);

}  // namespace dmocbench
