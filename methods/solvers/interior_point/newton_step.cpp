#include "methods/solvers/interior_point/newton_step.hpp"

#include <algorithm>

#include "methods/runtime/clock.hpp"
#include "methods/runtime/long_vectors.hpp"
#include "methods/solvers/interior_point/constants.hpp"

namespace dmocbench::interior_point {

double InertiaShift::last_over(double divisor) const noexcept {
  constexpr double smallest = 1e-20;
  return std::max(smallest, last_ / divisor);
}

void InertiaShift::begin() noexcept { shift_ = grows_ ? last_over(3.0) : is_flat_ ? last_over(100.0) : 0.0; }

void InertiaShift::keep() noexcept {
  grows_ = last_ > 0.0 && shift_ > last_over(3.0);
  if (shift_ > 0.0) last_ = shift_;
}

bool InertiaShift::raise(kkt::FactorisationStatus status) noexcept {
  constexpr double largest = 1e20;
  is_flat_ = is_flat_ || (shift_ == 0.0 && status == kkt::FactorisationStatus::singular);
  const double first = is_flat_ ? 1e-8 : 1e-4;
  const bool is_first = last_ == 0.0;
  shift_ = shift_ > 0.0 ? shift_ * (is_first ? 100.0 : 8.0) : is_first ? first : last_over(3.0);
  return shift_ <= largest;
}

NewtonStep::NewtonStep(const BarrierProgram& program, kkt::KktSystem& kkt) : program_(program), kkt_(kkt) {
  set_zero(diagonal_, static_cast<Eigen::Index>(program.program().variable_count()));
  if (program.has_bounds()) {
    set_zero(sigma_.x, diagonal_.size());
    set_zero(gradient_.x, diagonal_.size());
  }
  if (program.inequalities().empty()) return;
  set_zero(compliance_, static_cast<Eigen::Index>(program.program().constraint_count()));
  set_zero(constraints_, compliance_.size());
  sigma_.s.setZero(static_cast<Eigen::Index>(program.inequalities().size()));
  gradient_.s.setZero(sigma_.s.size());
}

void NewtonStep::begin_solve() {
  kkt_.begin_solve();
  shift_ = {};
  factorisations_ = 0;
  linear_seconds_ = 0.0;
}

bool NewtonStep::compute(const Iterate& at, double mu, const Primal& gradient, const Eigen::VectorXd& constraints,
                         Iterate& step) {
  if (program_.has_bounds()) {
    copy_to(gradient_.x, gradient.x);
    gradient_.s = gradient.s;
    set_zero(sigma_.x, sigma_.x.size());
    sigma_.s.setZero();
    program_.bounds().add_barrier(at, at.z, mu, sigma_, gradient_);
  }
  for (shift_.begin();;) {
    const kkt::KktRightHandSide reduced =
        reduce(shift_.value(), program_.has_bounds() ? gradient_.x : gradient.x, constraints, step);
    const Clock::time_point begin = Clock::now();
    const kkt::FactorisationStatus status =
        kkt_.solve(matrix_with(program_.hessian()), reduced, {.primal = step.x, .multipliers = step.multipliers});
    linear_seconds_ += seconds_since(begin);
    if (status == kkt::FactorisationStatus::solved) break;
    // The factorisation does not solve where a number is not finite. To look for one before would cost as much as half
    // a sweep.
    if (!is_finite(program_.hessian()) || !shift_.raise(status)) return false;
  }
  shift_.keep();
  set_eliminated_steps(at, mu, step);
  return true;
}

bool NewtonStep::correct(const Iterate& at, double mu, const Primal& gradient, const Eigen::VectorXd& constraints,
                         Iterate& step) {
  const Eigen::VectorXd& with_barrier = program_.has_bounds() ? gradient_.x : gradient.x;
  if (!solve(program_.hessian(), shift_.value(), with_barrier, constraints, step)) return false;
  set_eliminated_steps(at, mu, step);
  return true;
}

bool NewtonStep::feasibility_step(const Iterate& at, double mu, const Eigen::VectorXd& constraints, Iterate& step) {
  gradient_.s.setZero();
  sigma_.x.setZero();
  sigma_.s.setZero();
  program_.bounds().add_nearness(at, mu, sigma_);
  if (no_gradient_.size() == 0) no_gradient_.setZero(diagonal_.size());
  if (!solve_least_squares(no_gradient_, constraints, step)) return false;
  set_eliminated_steps(at, mu, step);
  return true;
}

void NewtonStep::estimate_multipliers(Iterate& at) {
  set_zero(at.multipliers, at.multipliers.size());
  if (program_.has_bounds()) {
    copy_to(gradient_.x, program_.gradient());
    gradient_.s.setZero();
    program_.bounds().subtract_multipliers(at.z, gradient_);
  }
  const Eigen::VectorXd& gradient = program_.has_bounds() ? gradient_.x : program_.gradient();
  // The multipliers of a zero gradient are zero, as where the cost is a square of controls and the guess has none.
  if (largest_of(gradient) == 0.0 && gradient_.s.isZero(0.0)) return;
  set_zero(sigma_.x, sigma_.x.size());
  sigma_.s.setZero();
  if (no_constraints_.size() == 0) set_zero(no_constraints_, at.multipliers.size());
  Iterate& step = of_least_squares_;
  if (!solve_least_squares(gradient, no_constraints_, step)) return;
  if (largest_of(step.multipliers) <= constants::lambda_max) copy_to(at.multipliers, step.multipliers);
}

double NewtonStep::directional_derivative(const Iterate& at, double mu, const Iterate& step) const {
  const double of_objective = dot_product(program_.gradient(), step.x);
  return program_.has_bounds() ? of_objective + mu * program_.bounds().barrier_derivative(at, step) : of_objective;
}

/// Prepares the matrix and returns the right-hand side, with the slacks eliminated: ds = E (dλ - ∇_s), E the
/// compliance.
kkt::KktRightHandSide NewtonStep::reduce(double shift, const Eigen::VectorXd& gradient,
                                         const Eigen::VectorXd& constraints, Iterate& step) {
  resize_unwritten(step.x, diagonal_.size());
  resize_unwritten(step.multipliers, constraints.size());
  ++factorisations_;
  if (program_.has_bounds() || shift != diagonal_shift_) {
    diagonal_shift_ = shift;
    for_stretches(diagonal_.size(), [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
      auto part = diagonal_.segment(begin, length);
      if (program_.has_bounds()) {
        part = sigma_.x.segment(begin, length).array() + shift;
      } else {
        part.setConstant(shift);
      }
    });
  }
  if (program_.inequalities().empty()) return {.gradient = gradient, .constraints = constraints};
  copy_to(constraints_, constraints);
  Eigen::Index slack = 0;
  for (const Eigen::Index row : program_.inequalities()) {
    compliance_[row] = 1.0 / (sigma_.s[slack] + shift);
    constraints_[row] += compliance_[row] * gradient_.s[slack++];
  }
  return {.gradient = gradient, .constraints = constraints_};
}

bool NewtonStep::solve(const Eigen::VectorXd& hessian, double shift, const Eigen::VectorXd& gradient,
                       const Eigen::VectorXd& constraints, Iterate& step) {
  const kkt::KktRightHandSide reduced = reduce(shift, gradient, constraints, step);
  const Clock::time_point begin = Clock::now();
  const kkt::FactorisationStatus status =
      kkt_.solve(matrix_with(hessian), reduced, {.primal = step.x, .multipliers = step.multipliers});
  linear_seconds_ += seconds_since(begin);
  return status == kkt::FactorisationStatus::solved;
}

/// Solves with the unit matrix in place of the Hessian.
bool NewtonStep::solve_least_squares(const Eigen::VectorXd& gradient, const Eigen::VectorXd& constraints,
                                     Iterate& step) {
  if (no_hessian_.size() == 0) set_zero(no_hessian_, program_.hessian().size());
  shift_.clear();
  return solve(no_hessian_, 1.0, gradient, constraints, step);
}

/// The steps of slacks and of multipliers of bounds, from the steps of x and λ.
void NewtonStep::set_eliminated_steps(const Iterate& at, double mu, Iterate& step) const {
  const std::vector<Eigen::Index>& inequalities = program_.inequalities();
  step.s.resize(static_cast<Eigen::Index>(inequalities.size()));
  for (Eigen::Index j = 0; j < step.s.size(); ++j) {
    const Eigen::Index row = inequalities[static_cast<std::size_t>(j)];
    step.s[j] = compliance_[row] * (step.multipliers[row] - gradient_.s[j]);
  }
  for (std::size_t set = 0; set < at.z.size(); ++set) step.z[set].resize(at.z[set].size());
  program_.bounds().set_multiplier_step(at, at.z, mu, step, step.z);
}

}  // namespace dmocbench::interior_point
