#include "methods/solvers/interior_point/barrier_program.hpp"

#include <algorithm>
#include <cmath>

#include "methods/solvers/clock.hpp"
#include "methods/solvers/interior_point/long_vectors.hpp"

namespace dmocbench::interior_point {

namespace {

/// Moves a number away from its bounds: by this share of their size, at most of their distance.
double pushed_inside(double value, double lower, double upper, double share) {
  const double distance = upper - lower;  // infinite where a bound is missing
  if (std::isfinite(lower)) value = std::max(value, lower + share * std::min(std::max(1.0, std::abs(lower)), distance));
  if (std::isfinite(upper)) value = std::min(value, upper - share * std::min(std::max(1.0, std::abs(upper)), distance));
  return value;
}

void push_inside(Eigen::VectorXd& vector, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double share) {
  for (Eigen::Index i = 0; i < vector.size(); ++i) {
    vector[i] = lower[i] == upper[i] ? lower[i] : pushed_inside(vector[i], lower[i], upper[i], share);
  }
}

}  // namespace

BarrierProgram::BarrierProgram(NonlinearProgram& program)
    : program_(program),
      x_lower_(bounds_of(program.variable_lower(), program.variable_upper())),
      x_upper_(bounds_of(program.variable_upper(), program.variable_lower())),
      s_lower_(bounds_of(program.constraint_lower(), program.constraint_upper())),
      s_upper_(bounds_of(program.constraint_upper(), program.constraint_lower())),
      jacobian_runs_(pattern_runs(program.jacobian_structure())),
      gradient_(static_cast<Eigen::Index>(program.variable_count())),
      jacobian_(static_cast<Eigen::Index>(program.jacobian_structure().size())),
      hessian_(static_cast<Eigen::Index>(program.hessian_structure().size())) {
  for (const BoundList* list : {&x_lower_, &x_upper_, &s_lower_, &s_upper_}) bound_count_ += list->values.size();
  const Eigen::VectorXd& lower = program.constraint_lower();
  const Eigen::VectorXd& upper = program.constraint_upper();
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (lower[i] != upper[i]) inequalities_.push_back(i);
  }
}

template <class Evaluation>
void BarrierProgram::timed(const Evaluation& evaluation) {
  const Clock::time_point begin = Clock::now();
  evaluation();
  evaluation_seconds_ += seconds_since(begin);
}

Point BarrierProgram::interior(const Eigen::VectorXd& start, double push) {
  Point point;
  point.x = start;
  push_inside(point.x, program_.variable_lower(), program_.variable_upper(), push);
  point.s.resize(static_cast<Eigen::Index>(program_.constraint_count()));
  program_.constraints(point.x, point.s);
  push_inside(point.s, program_.constraint_lower(), program_.constraint_upper(), push);
  point.multipliers.setZero(point.s.size());
  point.x_lower.setOnes(x_lower_.values.size());
  point.x_upper.setOnes(x_upper_.values.size());
  point.s_lower.setOnes(s_lower_.values.size());
  point.s_upper.setOnes(s_upper_.values.size());
  return point;
}

void BarrierProgram::balance_bounds(double mu, Point& point) const {
  Eigen::VectorXd slope;
  static_cast<void>(slope_of_lagrangian(point.multipliers, slope));  // whether it is finite is asked where it is used
  const auto balance = [mu](const Eigen::VectorXd& vector, const BoundList& bounds, double side,
                            const Eigen::VectorXd& of_vector, Eigen::VectorXd& z) {
    for (std::size_t b = 0; b < bounds.entries.size(); ++b) {
      const double of_barrier = mu / bounds.distance(vector, side, b);
      z[static_cast<Eigen::Index>(b)] = std::max(of_barrier, side * of_vector[bounds.entries[b]]);
    }
  };
  const Eigen::VectorXd slack_slope = -point.multipliers;
  balance(point.x, x_lower_, 1.0, slope, point.x_lower);
  balance(point.x, x_upper_, -1.0, slope, point.x_upper);
  balance(point.s, s_lower_, 1.0, slack_slope, point.s_lower);
  balance(point.s, s_upper_, -1.0, slack_slope, point.s_upper);
}

bool BarrierProgram::evaluate(const Eigen::VectorXd& x, double& objective, Eigen::VectorXd& rows) {
  timed([&] {
    objective = program_.objective(x);
    program_.constraints(x, rows);
  });
  ++evaluations_;
  return std::isfinite(objective) && is_finite(rows);
}

void BarrierProgram::differentiate(const Eigen::VectorXd& x) {
  timed([&] {
    program_.gradient(x, gradient_);
    program_.jacobian(x, jacobian_);
  });
}

void BarrierProgram::evaluate_hessian(const Point& point) {
  timed([&] { program_.hessian(point.x, 1.0, point.multipliers, hessian_); });
}

bool BarrierProgram::slope_of_lagrangian(const Eigen::VectorXd& multipliers, Eigen::VectorXd& result) const {
  copy_to(result, gradient_);
  add_transposed_product(jacobian_runs_, jacobian_, multipliers, result);
  return is_finite(result);
}

double BarrierProgram::barrier(const Point& point) const {
  return barrier_of(point.x, x_lower_, 1.0) + barrier_of(point.x, x_upper_, -1.0) + barrier_of(point.s, s_lower_, 1.0) +
         barrier_of(point.s, s_upper_, -1.0);
}

}  // namespace dmocbench::interior_point
