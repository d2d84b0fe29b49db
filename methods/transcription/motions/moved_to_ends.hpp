#pragma once

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

/// A motion moved to the states that `bounds` fix at the ends of its horizon, by the cubic polynomial in time that has
/// the missing q and v there; free entries of an end are not moved. Controls stay.
///
/// The start of a program from the answer of a neighbour with other ends. Where only its end nodes are moved, the
/// displacement δ occurs in one interval, whose mean velocity is wrong by δ/h, more than the motion itself may be
/// fast: methods that have no velocities among their unknowns (DMOC, and Hamiltonian collocation by p = L_v) then start
/// far from where their equations are linear.
[[nodiscard]] Motion moved_to_ends(const Motion& motion, const ProblemBounds& bounds);

}  // namespace dmocbench
