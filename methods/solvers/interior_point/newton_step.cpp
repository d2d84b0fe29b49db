#include "methods/solvers/interior_point/newton_step.hpp"

#include <algorithm>
#include <cmath>

#include "methods/runtime/clock.hpp"
#include "methods/runtime/long_vectors.hpp"

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
  set_zero(diagonal_, static_cast<Eigen::Index>(program.program().variable_count()));
  if (program.has_bounds()) {
    set_zero(sigma_, diagonal_.size());
    set_zero(slope_, diagonal_.size());
  }
  if (!program.inequalities().empty()) {
    set_zero(compliance_, static_cast<Eigen::Index>(program.program().constraint_count()));
    set_zero(right_rows_, compliance_.size());
    slack_sigma_.setZero(static_cast<Eigen::Index>(program.inequalities().size()));
    slack_slope_.setZero(slack_sigma_.size());
  }
}

void NewtonStep::fill_barrier(const Point& point, double mu, const Eigen::VectorXd& slope) {
  if (!program_.has_bounds()) return;
  copy_to(slope_, slope);
  sigma_.setZero();
  slack_sigma_.setZero();
  slack_slope_ = program_.slope_of_slacks(point.multipliers);
  add_barrier(point.x, program_.x_lower(), point.x_lower, 1.0, mu, sigma_, slope_);
  add_barrier(point.x, program_.x_upper(), point.x_upper, -1.0, mu, sigma_, slope_);
  add_barrier(point.s, program_.s_lower(), point.s_lower, 1.0, mu, slack_sigma_, slack_slope_);
  add_barrier(point.s, program_.s_upper(), point.s_upper, -1.0, mu, slack_sigma_, slack_slope_);
}

void NewtonStep::fill_diagonal(double constant) {
  if (sigma_.size() == 0 && constant == constant_) return;
  constant_ = constant;
  for_stretches(diagonal_.size(), [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
    if (sigma_.size() > 0) {
      diagonal_.segment(begin, length) = sigma_.segment(begin, length).array() + constant;
    } else {
      diagonal_.segment(begin, length).setConstant(constant);
    }
  });
}

FactorisationStatus NewtonStep::solve(const Eigen::VectorXd& hessian, double constant, const Eigen::VectorXd& slope,
                                      const Eigen::VectorXd& rows, Direction& direction) {
  fill_diagonal(constant);
  const std::vector<Eigen::Index>& inequalities = program_.inequalities();
  if (!inequalities.empty()) copy_to(right_rows_, rows);
  for (std::size_t j = 0; j < inequalities.size(); ++j) {
    const Eigen::Index row = inequalities[j];
    const auto slack = static_cast<Eigen::Index>(j);
    compliance_[row] = 1.0 / (slack_sigma_[slack] + constant);
    right_rows_[row] += compliance_[row] * slack_slope_[slack];
  }
  resize_unwritten(direction.x, diagonal_.size());
  resize_unwritten(direction.multipliers, rows.size());
  ++factorisations_;
  const Clock::time_point begin = Clock::now();
  const FactorisationStatus verdict =
      kkt_.solve({hessian, program_.jacobian(), diagonal_, compliance_},
                 {.gradient = slope, .constraints = inequalities.empty() ? rows : right_rows_},
                 {.primal = direction.x, .multipliers = direction.multipliers});
  linear_seconds_ += seconds_since(begin);
  return verdict;
}

void NewtonStep::complete(const Point& point, double mu, Direction& direction) const {
  if (!program_.has_bounds()) return;
  direction.s =
      compliance_(program_.inequalities()).cwiseProduct(direction.multipliers(program_.inequalities()) - slack_slope_);
  set_bound_step(point.x, direction.x, program_.x_lower(), point.x_lower, 1.0, mu, direction.x_lower);
  set_bound_step(point.x, direction.x, program_.x_upper(), point.x_upper, -1.0, mu, direction.x_upper);
  set_bound_step(point.s, direction.s, program_.s_lower(), point.s_lower, 1.0, mu, direction.s_lower);
  set_bound_step(point.s, direction.s, program_.s_upper(), point.s_upper, -1.0, mu, direction.s_upper);
}

bool NewtonStep::compute(const Point& point, double mu, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                         Direction& direction) {
  fill_barrier(point, mu, slope);
  const Eigen::VectorXd& of_barrier = program_.has_bounds() ? slope_ : slope;
  shift_.begin();
  while (solve(program_.hessian(), shift_.value(), of_barrier, rows, direction) != FactorisationStatus::solved) {
    // A number that is not finite shows in the verdict; to look for it before every step would take as long as a sweep.
    if (!is_finite(program_.hessian()) || !shift_.raise()) return false;
  }
  shift_.keep();
  complete(point, mu, direction);
  return true;
}

bool NewtonStep::correct(const Point& point, double mu, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                         Direction& direction) {
  const Eigen::VectorXd& of_barrier = program_.has_bounds() ? slope_ : slope;
  if (solve(program_.hessian(), shift_.value(), of_barrier, rows, direction) != FactorisationStatus::solved)
    return false;
  complete(point, mu, direction);
  return true;
}

/// Made when it is needed, which is rare.
const Eigen::VectorXd& NewtonStep::no_hessian() {
  if (no_hessian_.size() == 0) no_hessian_.setZero(program_.hessian().size());
  return no_hessian_;
}

bool NewtonStep::towards_rows(const Point& point, double mu, const Eigen::VectorXd& rows, Direction& direction) {
  constexpr double of_a_unit_of_length = 1.0;
  const Eigen::VectorXd no_slope = Eigen::VectorXd::Zero(diagonal_.size());
  slack_slope_.setZero();
  sigma_.setZero();
  slack_sigma_.setZero();
  add_nearness(point.x, program_.x_lower(), mu, sigma_);
  add_nearness(point.x, program_.x_upper(), mu, sigma_);
  add_nearness(point.s, program_.s_lower(), mu, slack_sigma_);
  add_nearness(point.s, program_.s_upper(), mu, slack_sigma_);
  shift_.clear();
  if (solve(no_hessian(), of_a_unit_of_length, no_slope, rows, direction) != FactorisationStatus::solved) return false;
  if (program_.inequalities().empty()) return true;
  direction.s = compliance_(program_.inequalities()).cwiseProduct(direction.multipliers(program_.inequalities()));
  return true;
}

void NewtonStep::estimate_multipliers(Point& point) {
  constexpr double largest = 1e3;
  constexpr double of_a_unit_of_slope = 1.0;
  Direction direction;
  point.multipliers.setZero();
  if (program_.has_bounds()) {
    // With the multipliers of the bounds as they are.
    copy_to(slope_, program_.gradient());
    subtract_multipliers(program_.x_lower(), point.x_lower, 1.0, slope_);
    subtract_multipliers(program_.x_upper(), point.x_upper, -1.0, slope_);
    slack_slope_.setZero();
    subtract_multipliers(program_.s_lower(), point.s_lower, 1.0, slack_slope_);
    subtract_multipliers(program_.s_upper(), point.s_upper, -1.0, slack_slope_);
  }
  const Eigen::VectorXd& slope = program_.has_bounds() ? slope_ : program_.gradient();
  // No slope asks for no multipliers: so it is where the cost is a square of controls and the guess has none.
  if (slope.isZero(0.0) && slack_slope_.isZero(0.0)) return;
  sigma_.setZero();
  slack_sigma_.setZero();
  shift_.clear();
  const FactorisationStatus verdict =
      solve(no_hessian(), of_a_unit_of_slope, slope, Eigen::VectorXd::Zero(point.multipliers.size()), direction);
  if (verdict != FactorisationStatus::solved || !(direction.multipliers.lpNorm<Eigen::Infinity>() <= largest)) return;
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
