#pragma once

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// Wall clock of one evaluation [s].
struct EvaluationTimes {
  double residual = 0.0;  ///< of all constraints
  double gradient = 0.0;
  double jacobian = 0.0;
  double hessian = 0.0;  ///< of the Lagrangian
};

/// Medians of repeated evaluations at one point. The rounds go through all of them in turn, so that whatever slows the
/// machine down for a while slows them all; short evaluations are repeated within a round until the clock can tell.
[[nodiscard]] EvaluationTimes measure_evaluations(NonlinearProgram& program, const Eigen::VectorXd& x,
                                                  const Eigen::VectorXd& multipliers);

}  // namespace dmocbench
