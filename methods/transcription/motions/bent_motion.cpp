#include "methods/transcription/motions/bent_motion.hpp"

#include <cmath>
#include <numbers>

namespace dmocbench {

Motion bent(const Motion& motion, const Eigen::MatrixXd& amplitudes, const Eigen::MatrixXd& of_control) {
  const auto at = [motion, amplitudes, of_control](double t) {
    MotionPoint point = motion.at(t);
    for (Eigen::Index k = 0; k < amplitudes.cols(); ++k) {
      const double frequency = static_cast<double>(k + 1) * std::numbers::pi / motion.horizon;
      point.q += amplitudes.col(k) * std::sin(frequency * t);
      point.v += amplitudes.col(k) * (frequency * std::cos(frequency * t));
    }
    for (Eigen::Index k = 0; k < of_control.cols(); ++k) {
      point.u += of_control.col(k) * std::cos(static_cast<double>(k) * std::numbers::pi * t / motion.horizon);
    }
    return point;
  };
  return {at, motion.horizon, motion.unknowns};
}

}  // namespace dmocbench
