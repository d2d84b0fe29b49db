#include "methods/solvers/batch/lane_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "methods/solvers/interior_point/constants.hpp"

namespace dmocbench::batch {

namespace {

/// From a bound; positive inside.
template <class Bound>
OfLanes distance(const Bound& bound, const LaneVector& primal) {
  return bound.side * (primal[bound.entry] - bound.value);
}

/// The longest step, at most 1, where no distance shrinks by more than the share τ and the largest loss is this.
OfLanes boundary_fraction(const OfLanes& largest_loss, const OfLanes& tau) {
  return (largest_loss > tau).select(tau / largest_loss, 1.0);
}

}  // namespace

LaneBounds::LaneBounds(const NonlinearProgram& program, const std::vector<Eigen::Index>& inequalities) {
  const Eigen::Index n = program.variable_lower().size();
  for (Eigen::Index i = 0; i < n; ++i) add(i, program.variable_lower()[i], program.variable_upper()[i]);
  Eigen::Index slack = n;
  for (const Eigen::Index row : inequalities) {
    add(slack++, program.constraint_lower()[row], program.constraint_upper()[row]);
  }
  count_ = static_cast<Eigen::Index>(bounds_.size());
}

void LaneBounds::add(Eigen::Index entry, double lower, double upper) {
  if (lower == upper) return;
  if (std::isfinite(lower)) bounds_.push_back({entry, 1.0, lower, upper});
  if (std::isfinite(upper)) bounds_.push_back({entry, -1.0, upper, lower});
}

/// `visit(bound, i)`, i the place of its multiplier.
template <class Visit>
void LaneBounds::for_each(const Visit& visit) const {
  for (Eigen::Index i = 0; const OneSidedBound& bound : bounds_) visit(bound, i++);
}

void LaneBounds::push_inside(std::size_t lane, double push, Eigen::Index begin, Eigen::Index end,
                             LaneVector& primal) const {
  auto point = primal.of(lane);
  for (const OneSidedBound& bound : bounds_) {
    if (bound.entry < begin || bound.entry >= end) continue;
    const double room = std::min(std::max(1.0, std::abs(bound.value)), std::abs(bound.other - bound.value));
    double& value = point[bound.entry];
    const double nearest = bound.value + bound.side * push * room;
    value = bound.side > 0.0 ? std::max(value, nearest) : std::min(value, nearest);
  }
}

void LaneBounds::balance(std::size_t lane, double mu, const LaneVector& primal, const LaneVector& gradient,
                         LaneVector& z) const {
  const auto point = primal.of(lane);
  const auto of_lane = gradient.of(lane);
  auto multipliers = z.of(lane);
  for_each([&](const OneSidedBound& bound, Eigen::Index i) {
    const double d = bound.side * (point[bound.entry] - bound.value);
    multipliers[i] = std::max(mu / d, bound.side * of_lane[bound.entry]);
  });
}

/// Of eight numbers at a time: a product is cheaper than eight logarithms.
OfLanes LaneBounds::barrier(const LaneVector& primal) const {
  constexpr Eigen::Index at_once = 8;
  OfLanes sum = OfLanes::Zero();
  for (Eigen::Index begin = 0; begin < count_; begin += at_once) {
    const auto first = static_cast<std::size_t>(begin);
    const auto last = static_cast<std::size_t>(std::min(count_, begin + at_once));
    OfLanes product = OfLanes::Ones();
    bool is_usual = true;
    for (std::size_t i = first; i < last; ++i) product *= distance(bounds_[i], primal);
    is_usual = (product > 1e-200).all() && (product < 1e200).all();
    if (is_usual) {
      sum -= product.log();
    } else {
      for (std::size_t i = first; i < last; ++i) sum -= distance(bounds_[i], primal).log();
    }
  }
  return sum;
}

OfLanes LaneBounds::barrier_derivative(const LaneVector& primal, const LaneVector& step) const {
  OfLanes sum = OfLanes::Zero();
  for (const OneSidedBound& bound : bounds_) sum -= bound.side * step[bound.entry] / distance(bound, primal);
  return sum;
}

void LaneBounds::add_barrier(const LaneVector& primal, const LaneVector& z, const OfLanes& mu, LaneVector& sigma,
                             LaneVector& gradient) const {
  for_each([&](const OneSidedBound& bound, Eigen::Index i) {
    const OfLanes reciprocal = 1.0 / distance(bound, primal);
    sigma[bound.entry] += z[i] * reciprocal;
    gradient[bound.entry] -= bound.side * mu * reciprocal;
  });
}

void LaneBounds::subtract_multipliers(const LaneVector& z, LaneVector& gradient) const {
  for_each([&](const OneSidedBound& bound, Eigen::Index i) { gradient[bound.entry] -= bound.side * z[i]; });
}

void LaneBounds::subtract_multipliers(std::size_t lane, const LaneVector& z, LaneVector& gradient) const {
  const auto multipliers = z.of(lane);
  auto of_lane = gradient.of(lane);
  for_each([&](const OneSidedBound& bound, Eigen::Index i) { of_lane[bound.entry] -= bound.side * multipliers[i]; });
}

void LaneBounds::products(const LaneVector& primal, const LaneVector& z, OfLanes& smallest, OfLanes& largest) const {
  smallest.setConstant(unbounded);
  largest.setZero();
  for_each([&](const OneSidedBound& bound, Eigen::Index i) {
    const OfLanes product = distance(bound, primal) * z[i];
    smallest = smallest.min(product);
    largest = largest.max(product);
  });
}

void LaneBounds::set_multiplier_step(const LaneVector& primal, const LaneVector& z, const OfLanes& mu,
                                     const LaneVector& step, LaneVector& z_step) const {
  for_each([&](const OneSidedBound& bound, Eigen::Index i) {
    z_step[i] = (mu - bound.side * z[i] * step[bound.entry]) / distance(bound, primal) - z[i];
  });
}

OfLanes LaneBounds::fraction_to_boundary(const LaneVector& primal, const LaneVector& step, const OfLanes& tau) const {
  OfLanes largest_loss = OfLanes::Zero();
  for (const OneSidedBound& bound : bounds_) {
    largest_loss = largest_loss.max(-bound.side * step[bound.entry] / distance(bound, primal));
  }
  return boundary_fraction(largest_loss, tau);
}

OfLanes LaneBounds::multiplier_fraction_to_boundary(const LaneVector& z, const LaneVector& z_step,
                                                    const OfLanes& tau) const {
  OfLanes largest_loss = OfLanes::Zero();
  for (Eigen::Index i = 0; i < count_; ++i) largest_loss = largest_loss.max(-z_step[i] / z[i]);
  return boundary_fraction(largest_loss, tau);
}

void LaneBounds::update_multipliers(const LaneVector& primal, const LaneVector& z_step, const OfLanes& length,
                                    const OfLanes& mu, LaneVector& z) const {
  for_each([&](const OneSidedBound& bound, Eigen::Index i) {
    using interior_point::constants::kappa_sigma;
    const OfLanes d = distance(bound, primal);
    const OfLanes moved = (z[i] + length * z_step[i]).max((mu / kappa_sigma) / d).min((mu * kappa_sigma) / d);
    z[i] = (length > 0.0).select(moved, z[i]);
  });
}

}  // namespace dmocbench::batch
