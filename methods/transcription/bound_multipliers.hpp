#pragma once

#include <Eigen/Core>

#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The prices of all bounds except of integrals, at an optimum with its multipliers. With ℓ = φ + λᵀa, the least
/// cost grows by ∂ℓ/∂x with a bound on an unknown x, and by -λ with a bound on a row; both are divided by the cost
/// scale, and at stages by h b_i. One evaluation of the program's first derivatives, none where nothing is bounded.
[[nodiscard]] BoundMultipliers bound_multipliers(Transcription& program, const Eigen::VectorXd& primal,
                                                 const Eigen::VectorXd& multipliers);

}  // namespace dmocbench
