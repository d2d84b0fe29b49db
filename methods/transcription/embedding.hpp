#pragma once

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// A trajectory written in the unknowns of a transcription on the same grid with the same tableau, whichever method it
/// came from: nodes q with p or v, interior rates Q̇_j with Ṗ_j = (L_q + f)(stage j) or V̇_j from the equations of
/// motion, controls; where they are unknowns, velocities of the ends and the horizon. Nothing is moved to meet bounds
/// or constraints: the residuals of the constraints show how far two methods agree (th:equi). For the Bolza form.
/// Throws `Error` if grid or stages differ.
[[nodiscard]] Eigen::VectorXd embed(const Problem& problem, const Transcription& transcription,
                                    const Trajectory& trajectory);

}  // namespace dmocbench
