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

/// The symbolic derivatives of every interval replayed in long double (64 bits of mantissa instead of 53) and added up
/// here; the program's own back end and assembly play no part. `x` has an entry per variable, `multipliers` one per
/// row.
[[nodiscard]] DerivativeReference reference_derivatives(const Transcription& program, const Eigen::VectorXd& x,
                                                        double objective_factor, const Eigen::VectorXd& multipliers);

/// Largest difference of an entry relative to the largest entry of the reference; NaN if a value is NaN.
[[nodiscard]] double relative_error(const Eigen::VectorXd& values, const std::vector<long double>& reference);

}  // namespace dmocbench
