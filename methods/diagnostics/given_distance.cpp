#include "methods/diagnostics/given_distance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace dmocbench {

namespace {

/// The same for one of q and q̇, of which `ranges` are all that hold at one time; some may be empty.
double distance_between(const std::vector<Bounds>& ranges) {
  const Eigen::Index n = ranges.front().lower.size();
  Eigen::VectorXd gaps = Eigen::VectorXd::Zero(n);
  for (const Bounds& a : ranges) {
    for (const Bounds& b : ranges) {
      if (a.lower.size() == n && b.upper.size() == n) gaps = gaps.cwiseMax(a.lower - b.upper);
    }
  }
  return gaps.stableNorm();
}

/// By how much a state at a node leaves its bounds, as a length: velocities count by what they move in the horizon.
double outside(const EndBounds& bounds, const Trajectory& motion, Eigen::Index node) {
  const auto excess = [](const Bounds& range, const Eigen::VectorXd& x) {
    return (range.lower - x).cwiseMax(x - range.upper).cwiseMax(0.0).stableNorm();
  };
  const double horizon = motion.node_times[motion.intervals()] - motion.node_times[0];
  return excess(bounds.q, motion.q.row(node).transpose()) + horizon * excess(bounds.v, motion.v.row(node).transpose());
}

}  // namespace

double given_distance(const ProblemBounds& bounds) {
  std::vector<Bounds> of_q{bounds.first.q, bounds.last.q};
  std::vector<Bounds> of_v{bounds.first.v, bounds.last.v};
  for (const InteriorBounds& interior : bounds.interior) {
    of_q.push_back(interior.q);
    of_v.push_back(interior.v);
  }
  return std::hypot(distance_between(of_q), distance_between(of_v));
}

std::string lost_distance(const ProblemBounds& bounds, const Trajectory& motion, const Accuracy& accuracy) {
  const double distance = given_distance(bounds);
  const double size = std::max(1.0, motion.q.lpNorm<Eigen::Infinity>());
  const double missed = static_cast<double>(motion.intervals()) * accuracy.jump + outside(bounds.first, motion, 0) +
                        outside(bounds.last, motion, motion.intervals());
  constexpr double most_missed = 0.5;
  if (!(distance > 0.0) || distance >= smallest_distance * size || missed < most_missed * distance) return {};
  return fmt::format(
      "The given states are {:.1e} apart, so little that a trajectory at rest satisfies the program to the tolerance. "
      "State the problem in units in which this distance is about 1.",
      distance);
}

}  // namespace dmocbench
