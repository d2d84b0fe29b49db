#include "methods/solvers/interior_point/newton_step.hpp"

#include <algorithm>
#include <cmath>

#include "methods/solvers/clock.hpp"
#include "methods/solvers/interior_point/long_vectors.hpp"

namespace dmocbench::interior_point {

double InertiaShift::third_of_last() const noexcept {
  constexpr double smallest = 1e-20;
  return std::max(smallest, last_ / 3.0);
}

void InertiaShift::begin() noexcept { shift_ = grows_ ? third_of_last() : 0.0; }

void InertiaShift::keep() noexcept {
  grows_ = last_ > 0.0 && shift_ > third_of_last();
  if (shift_ > 0.0) last_ = shift_;
}

bool InertiaShift::raise() noexcept {
  constexpr double first = 1e-4;
  constexpr double largest = 1e20;
  if (shift_ == 0.0) {
    shift_ = last_ == 0.0 ? first : third_of_last();
  } else {
    shift_ *= last_ == 0.0 ? 100.0 : 8.0;
  }
  return shift_ <= largest;
}

NewtonStep::NewtonStep(const BarrierProgram& program, KktSystem& kkt) : program_(program), kkt_(kkt) {
  const auto n = static_cast<Eigen::Index>(program.program().variable_count());
  const auto m = static_cast<Eigen::Index>(program.program().constraint_count());
  diagonal_.setZero(n);
  shifted_.setZero(n);
  slope_.setZero(n);
  slack_.setZero(m);
  softness_.setZero(m);
  slack_slope_.setZero(m);
  right_rows_.setZero(m);
  no_hessian_.setZero(program.hessian().size());
}

void NewtonStep::fill_barrier(const Point& point, double mu, const Eigen::VectorXd& slope) {
  copy_to(slope_, slope);
  if (!program_.has_bounds()) return;
  diagonal_.setZero();
  slack_.setZero();
  slack_slope_ = -point.multipliers;
  add_barrier(point.x, program_.x_lower(), point.x_lower, 1.0, mu, diagonal_, slope_);
  add_barrier(point.x, program_.x_upper(), point.x_upper, -1.0, mu, diagonal_, slope_);
  add_barrier(point.s, program_.s_lower(), point.s_lower, 1.0, mu, slack_, slack_slope_);
  add_barrier(point.s, program_.s_upper(), point.s_upper, -1.0, mu, slack_, slack_slope_);
}

Verdict NewtonStep::solve(const Eigen::VectorXd& hessian, const Eigen::VectorXd& rows, Direction& direction) {
  for_stretches(diagonal_.size(), [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
    shifted_.segment(begin, length) = diagonal_.segment(begin, length).array() + shift_.value();
  });
  copy_to(right_rows_, rows);
  for (const Eigen::Index i : program_.inequalities()) {
    softness_[i] = 1.0 / (slack_[i] + shift_.value());
    right_rows_[i] += softness_[i] * slack_slope_[i];
  }
  direction.x.resize(slope_.size());
  direction.multipliers.resize(rows.size());
  ++factorisations_;
  const Clock::time_point begin = Clock::now();
  const Verdict verdict = kkt_.solve({hessian, program_.jacobian(), shifted_, softness_}, slope_, right_rows_,
                                     direction.x, direction.multipliers);
  linear_seconds_ += seconds_since(begin);
  return verdict;
}

void NewtonStep::complete(const Point& point, double mu, Direction& direction) const {
  direction.s.resize(point.s.size());
  set_zero(direction.s);
  if (!program_.has_bounds()) return;
  for (const Eigen::Index i : program_.inequalities()) {
    direction.s[i] = softness_[i] * (direction.multipliers[i] - slack_slope_[i]);
  }
  direction.x_lower = bound_step(point.x, direction.x, program_.x_lower(), point.x_lower, 1.0, mu);
  direction.x_upper = bound_step(point.x, direction.x, program_.x_upper(), point.x_upper, -1.0, mu);
  direction.s_lower = bound_step(point.s, direction.s, program_.s_lower(), point.s_lower, 1.0, mu);
  direction.s_upper = bound_step(point.s, direction.s, program_.s_upper(), point.s_upper, -1.0, mu);
}

bool NewtonStep::compute(const Point& point, double mu, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                         Direction& direction) {
  fill_barrier(point, mu, slope);
  shift_.begin();
  while (solve(program_.hessian(), rows, direction) != Verdict::solved) {
    // A number that is not finite shows in the verdict; to look for it before every step would take as long as a sweep.
    if (!is_finite(program_.hessian()) || !shift_.raise()) return false;
  }
  shift_.keep();
  complete(point, mu, direction);
  return true;
}

bool NewtonStep::correct(const Point& point, double mu, const Eigen::VectorXd& rows, Direction& direction) {
  if (solve(program_.hessian(), rows, direction) != Verdict::solved) return false;
  complete(point, mu, direction);
  return true;
}

bool NewtonStep::towards_rows(const Point& point, double mu, const Eigen::VectorXd& rows, Direction& direction) {
  slope_.setZero();
  slack_slope_.setZero();
  diagonal_.setOnes();
  slack_.setOnes();
  add_nearness(point.x, program_.x_lower(), mu, diagonal_);
  add_nearness(point.x, program_.x_upper(), mu, diagonal_);
  add_nearness(point.s, program_.s_lower(), mu, slack_);
  add_nearness(point.s, program_.s_upper(), mu, slack_);
  shift_.clear();
  const Verdict verdict = solve(no_hessian_, rows, direction);
  diagonal_.setZero();
  if (verdict != Verdict::solved) return false;
  direction.s.setZero(point.s.size());
  for (const Eigen::Index i : program_.inequalities()) direction.s[i] = softness_[i] * direction.multipliers[i];
  return true;
}

void NewtonStep::estimate_multipliers(Point& point) {
  constexpr double largest = 1e3;
  constexpr double no_mu = 0.0;
  Direction direction;
  point.multipliers.setZero();
  fill_barrier(point, no_mu, program_.gradient());
  // The slope with the multipliers of the bounds as they are, where fill_barrier has those of the barrier.
  subtract_multipliers(program_.x_lower(), point.x_lower, 1.0, slope_);
  subtract_multipliers(program_.x_upper(), point.x_upper, -1.0, slope_);
  subtract_multipliers(program_.s_lower(), point.s_lower, 1.0, slack_slope_);
  subtract_multipliers(program_.s_upper(), point.s_upper, -1.0, slack_slope_);
  // No slope asks for no multipliers: so it is where the cost is a square of controls and the guess has none.
  if (slope_.isZero(0.0) && slack_slope_.isZero(0.0)) return;
  diagonal_.setOnes();
  slack_.setOnes();
  shift_.clear();
  const Verdict verdict = solve(no_hessian_, Eigen::VectorXd::Zero(point.s.size()), direction);
  diagonal_.setZero();
  if (verdict != Verdict::solved || !(direction.multipliers.lpNorm<Eigen::Infinity>() <= largest)) return;
  point.multipliers = direction.multipliers;
}

double NewtonStep::slope_along(const Point& point, double mu, const Direction& direction) const {
  double sum = dot_product(program_.gradient(), direction.x);
  if (!program_.has_bounds()) return sum;
  sum += mu * (barrier_slope(point.x, direction.x, program_.x_lower()) +
               barrier_slope(point.x, direction.x, program_.x_upper()) +
               barrier_slope(point.s, direction.s, program_.s_lower()) +
               barrier_slope(point.s, direction.s, program_.s_upper()));
  return sum;
}

}  // namespace dmocbench::interior_point
