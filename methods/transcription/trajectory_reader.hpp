#pragma once

#include <Eigen/Core>

#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The discrete motion that a vector of the program's unknowns stands for, by the same rules for every method.
///
/// p_k is one number per node: the left momentum of the interval to its right, at the last node the right momentum of
/// the last interval (for DMOC the forced discrete Legendre transforms (eq:varmech_dlegf)); v_k solves p_k = L_v(q_k,
/// v_k). The transcription's `traced_problem` gets the answer's unknown parameters. Costates are computed if
/// `multipliers` has an entry per constraint. Throws `Error` if L_vv is singular on the motion or a size is wrong.
[[nodiscard]] Trajectory read_trajectory(Transcription& transcription, const Eigen::VectorXd& primal,
                                         const Eigen::VectorXd& multipliers);

}  // namespace dmocbench
