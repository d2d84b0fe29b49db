#pragma once

#include <Eigen/Core>

#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

/// A motion with sines added that vanish at both ends of its horizon T: q gains Σ_k a_k sin((k + 1) π t / T), where a_k
/// is column k = 0, 1, ... of `amplitudes` (n rows, in the units of q), and v the derivative. The control gains
/// Σ_k b_k cos(k π t / T), with b_k the columns of `of_control` (m rows, in the units of u, or none: then it stays).
[[nodiscard]] Motion bent(const Motion& motion, const Eigen::MatrixXd& amplitudes,
                          const Eigen::MatrixXd& of_control = {});

}  // namespace dmocbench
