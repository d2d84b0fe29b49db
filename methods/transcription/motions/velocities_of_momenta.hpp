#pragma once

#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// Adds P_i = L_v(Q_i, Q̇_i) and the v_k with L_v(q_k, v_k) = p_k to a discrete motion that has all else; each solve
/// starts from the velocity of a nearby stage. With holonomic constraints G v_k = 0, and p_k becomes the projected
/// momentum L_v(q_k, v_k). Throws `Error` if L_vv is singular on the motion.
void add_velocities(const TracedProblem& problem, Trajectory& trajectory);

}  // namespace dmocbench
