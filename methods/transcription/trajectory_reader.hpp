#pragma once

#include <Eigen/Core>

#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// Adds P_i = L_v(Q_i, Q̇_i) and the v_k with L_v(q_k, v_k) = p_k to a discrete motion that has all else; each solve
/// starts from the velocity of a nearby stage. With constraints G v_k = 0, and p_k becomes the projected
/// momentum L_v(q_k, v_k). Throws `Error` if L_vv is singular on the motion.
void add_velocities(const TracedProblem& problem, Trajectory& trajectory);

/// The prices of all bounds except of integrals, at an optimum with its multipliers. With ℓ = φ + λᵀa, the least
/// cost grows by ∂ℓ/∂x with a bound on an unknown x, and by -λ with a bound on a row; both are divided by the cost
/// scale, and at stages by h b_i. One evaluation of the program's first derivatives, none where nothing is bounded.
[[nodiscard]] BoundMultipliers bound_multipliers(Transcription& program, const Eigen::VectorXd& primal,
                                                 const Eigen::VectorXd& multipliers);

/// The discrete motion that a vector of the program's unknowns stands for, by the same rules for every method.
///
/// p_k is one number per node: the left momentum of the interval to its right, at the last node the right momentum of
/// the last interval (for DMOC the forced discrete Legendre transforms (eq:varmech_dlegf)); v_k solves p_k = L_v(q_k,
/// v_k). Controls without bounds that formulas read through functions of period 2π only change by at most half a turn
/// from stage to stage, whatever turns the unknowns have. The transcription's `traced_problem` gets the answer's
/// unknown parameters. Costates are computed if `multipliers` has an entry per constraint. Throws `Error` if L_vv is
/// singular on the motion or a size is wrong.
[[nodiscard]] Trajectory read_trajectory(Transcription& transcription, const Eigen::VectorXd& primal,
                                         const Eigen::VectorXd& multipliers);

}  // namespace dmocbench
