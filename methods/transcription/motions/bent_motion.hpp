#pragma once

#include <Eigen/Core>

#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

/// A motion with sines added that vanish at both ends of its horizon T: q gains Σ_k a_k sin((k + 1) π t / T), where a_k
/// is column k = 0, 1, ... of `amplitudes` (n rows, in the units of q), and v the derivative. Controls stay.
[[nodiscard]] Motion bent(const Motion& motion, const Eigen::MatrixXd& amplitudes);

}  // namespace dmocbench
