#include "methods/solvers/batch/lane_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "methods/solvers/interior_point/barrier_bounds.hpp"

namespace dmocbench::batch {

LaneBounds::LaneBounds(const NonlinearProgram& program, const std::vector<Eigen::Index>& inequalities) {
  const Eigen::Index n = program.variable_lower().size();
  for (Eigen::Index i = 0; i < n; ++i) add(0, i, program.variable_lower()[i], program.variable_upper()[i]);
  Eigen::Index slack = n;
  for (const Eigen::Index row : inequalities) {
    add(2, slack++, program.constraint_lower()[row], program.constraint_upper()[row]);
  }
}

void LaneBounds::add(std::size_t set, Eigen::Index entry, double lower, double upper) {
  if (lower == upper) return;
  if (std::isfinite(lower)) stretches_.push_back({entry, 1.0, set, count_++, lower, upper});
  if (std::isfinite(upper)) stretches_.push_back({entry, -1.0, set + 1, count_++, upper, lower});
}

void LaneBounds::push_inside(std::size_t lane, double push, Eigen::Index begin, Eigen::Index end,
                             LaneVector& primal) const {
  auto point = primal.of(lane);
  for (const LaneBound& bound : stretches_) {
    if (bound.entry < begin || bound.entry >= end) continue;
    double& value = point[bound.entry];
    value = interior_point::pushed_inside(value, std::min(bound.value, bound.other), std::max(bound.value, bound.other),
                                          push);
  }
}

/// Multiplies eight numbers at a time: a product is cheaper than eight logarithms.
OfLanes LaneBounds::barrier(const LaneVector& primal) const {
  constexpr std::size_t at_once = 8;
  OfLanes sum = OfLanes::Zero();
  for (std::size_t begin = 0; begin < stretches_.size(); begin += at_once) {
    const std::size_t end = std::min(stretches_.size(), begin + at_once);
    OfLanes product = OfLanes::Ones();
    for (std::size_t i = begin; i < end; ++i) product *= stretches_[i].distances(primal);
    if ((product > 1e-200).all() && (product < 1e200).all()) {
      sum -= product.log();
    } else {
      for (std::size_t i = begin; i < end; ++i) sum -= stretches_[i].distances(primal).log();
    }
  }
  return sum;
}

}  // namespace dmocbench::batch
