#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// Jacobian and Hessian of the Lagrangian in long double, in the order of the program's structures.
struct DerivativeReference {
  std::vector<long double> jacobian;
  std::vector<long double> hessian;
};

/// The symbolic derivatives of every interval replayed in long double (64 bits of mantissa) and added up here; the
/// program's back end and assembly play no part. `x` has an entry per variable, `multipliers` one per constraint.
[[nodiscard]] DerivativeReference reference_derivatives(const Transcription& program, const Eigen::VectorXd& x,
                                                        double objective_factor, const Eigen::VectorXd& multipliers);

/// Largest difference of an entry relative to the largest entry of the reference; NaN if a value is NaN.
[[nodiscard]] double relative_error(const Eigen::VectorXd& values, const std::vector<long double>& reference);

/// Wall clock of one evaluation [s].
struct EvaluationTimes {
  double residual = 0.0;  ///< of all constraints
  double gradient = 0.0;
  double jacobian = 0.0;
  double hessian = 0.0;  ///< of the Lagrangian
};

/// Medians of repeated evaluations at one point. The rounds go through all of them in turn, so that a slow spell of the
/// machine slows them all; short evaluations are repeated within a round until the clock resolves them.
[[nodiscard]] EvaluationTimes measure_evaluations(NonlinearProgram& program, const Eigen::VectorXd& x,
                                                  const Eigen::VectorXd& multipliers);

}  // namespace dmocbench
