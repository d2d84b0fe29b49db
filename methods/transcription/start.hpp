#pragma once

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The unknowns of a program sampled from a motion, by the same rules for every method: q and v at the nodes,
/// p = L_v(q, v), rates of q and u at the times where they are unknowns, rates of p or v as mean rates of the interval.
/// A free horizon becomes the motion's, and so do unknown parameters; otherwise a motion with another horizon is
/// stretched to the program's. Variables are moved into their bounds.
[[nodiscard]] Eigen::VectorXd sample(Transcription& transcription, const Motion& motion);

/// The problem's own guess as a motion. The problem must outlive it.
[[nodiscard]] Motion guessed_motion(const Problem& problem);
/// The guess of the program's problem for the values that the program has now. The program must outlive it; values that
/// it is given later count.
[[nodiscard]] Motion guessed_motion(const Transcription& program);

/// A trajectory of any method in the unknowns of a transcription on the same grid with the same tableau: nodes q with p
/// or v, interior rates Q̇_j with Ṗ_j = (L_q + f)(stage j) or V̇_j from the equations of motion, controls, each by the
/// polynomial through the stages where its unknowns are at other times; where they are unknowns, velocities of the
/// ends, parameters and the horizon; multipliers of constraints by least squares to the rows. Nothing is
/// moved to meet bounds or constraints: the residuals of the constraints show how far two methods agree (th:equi). For
/// the Bolza form. Throws `Error` if grid or stages differ.
[[nodiscard]] Eigen::VectorXd embed(const Problem& problem, Transcription& transcription, const Trajectory& trajectory);

}  // namespace dmocbench
