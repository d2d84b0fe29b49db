#include "bench/experiments/sequence/one_interval_later.hpp"

namespace dmocbench {

Motion one_interval_later(const Trajectory& trajectory) {
  const Motion motion = smooth_motion(trajectory);
  const auto at = [motion, step = trajectory.step(0)](double t) {
    MotionPoint point = motion.at(t + step);
    const double beyond = t + step - motion.horizon;
    if (beyond > 0.0) point.q += beyond * point.v;
    return point;
  };
  return {at, motion.horizon, motion.unknowns};
}

Eigen::VectorXd shifted(const Places& places, const Eigen::VectorXd& values) {
  Eigen::VectorXd result = values;
  for (const PlaceRun& run : places.runs()) {
    if (run.kind == Place::Kind::border || run.count < 2) continue;
    const auto first = static_cast<Eigen::Index>(run.first);
    const auto moved = static_cast<Eigen::Index>(run.count) - 1;
    result.segment(first, moved) = values.segment(first + 1, moved);
  }
  return result;
}

}  // namespace dmocbench
