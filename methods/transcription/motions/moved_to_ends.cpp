#include "methods/transcription/motions/moved_to_ends.hpp"

namespace dmocbench {

namespace {

/// The values that bounds fix minus a state's; 0 for free entries.
Eigen::VectorXd missing(const Bounds& bounds, const Eigen::VectorXd& values) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (bounds.is_fixed(i)) result[i] = bounds.lower[i] - values[i];
  }
  return result;
}

/// The fixed state of an end minus a point of a motion.
BoundaryState missing(const EndBounds& end, const MotionPoint& point) {
  return {.q = missing(end.q, point.q), .v = missing(end.v, point.v), .y = missing(end.y, point.y)};
}

}  // namespace

Motion moved_to_ends(const Motion& motion, const ProblemBounds& bounds) {
  const double horizon = motion.horizon;
  const BoundaryState first = missing(bounds.first, motion.at(0.0));
  const BoundaryState last = missing(bounds.last, motion.at(horizon));
  const auto at = [=](double t) {
    const double s = t / horizon;
    const double r = 1.0 - s;
    MotionPoint point = motion.at(t);
    point.q += r * r * ((1.0 + 2.0 * s) * first.q + s * horizon * first.v);
    point.q += s * s * ((1.0 + 2.0 * r) * last.q - r * horizon * last.v);
    point.v += 6.0 * s * r / horizon * (last.q - first.q);
    point.y += r * first.y + s * last.y;
    point.v += r * (1.0 - 3.0 * s) * first.v + s * (3.0 * s - 2.0) * last.v;
    return point;
  };
  return {at, horizon, motion.unknowns};
}

}  // namespace dmocbench
