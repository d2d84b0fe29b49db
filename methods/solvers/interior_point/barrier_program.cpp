#include "methods/solvers/interior_point/barrier_program.hpp"

#include <algorithm>
#include <cmath>

#include "methods/runtime/long_vectors.hpp"

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
  for_each_bounded(lower, upper, [&](Eigen::Index i) {
    vector[i] = lower[i] == upper[i] ? lower[i] : pushed_inside(vector[i], lower[i], upper[i], share);
  });
}

std::vector<Eigen::Index> rows_with_slack(const NonlinearProgram& program) {
  const Eigen::VectorXd& lower = program.constraint_lower();
  const Eigen::VectorXd& upper = program.constraint_upper();
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (lower[i] != upper[i]) rows.push_back(i);
  }
  return rows;
}

Eigen::VectorXd values_of_equalities(const NonlinearProgram& program, const std::vector<Eigen::Index>& inequalities) {
  if (program.constraint_lower().isZero(0.0)) return {};
  Eigen::VectorXd values = program.constraint_lower();
  for (const Eigen::Index i : inequalities) values[i] = 0.0;
  return values;
}

}  // namespace

BarrierProgram::BarrierProgram(NonlinearProgram& program, const ProgramRuns& runs)
    : program_(program),
      x_lower_(bounds_of(program.variable_lower(), program.variable_upper(), 1.0)),
      x_upper_(bounds_of(program.variable_lower(), program.variable_upper(), -1.0)),
      inequalities_(rows_with_slack(program)),
      values_(values_of_equalities(program, inequalities_)),
      slope_of_rows_(MatrixProduct::transposed(runs.jacobian)) {
  resize_unwritten(gradient_, static_cast<Eigen::Index>(program.variable_count()));
  resize_unwritten(jacobian_, static_cast<Eigen::Index>(program.jacobian_structure().size()));
  resize_unwritten(hessian_, static_cast<Eigen::Index>(program.hessian_structure().size()));
  const Eigen::VectorXd lower = program.constraint_lower()(inequalities_);
  const Eigen::VectorXd upper = program.constraint_upper()(inequalities_);
  s_lower_ = bounds_of(lower, upper, 1.0);
  s_upper_ = bounds_of(lower, upper, -1.0);
  for (const BoundList* list : {&x_lower_, &x_upper_, &s_lower_, &s_upper_}) bound_count_ += list->values.size();
}

Point BarrierProgram::interior(const Eigen::VectorXd& start, double push) {
  Point point;
  copy_to(point.x, start);
  push_inside(point.x, program_.variable_lower(), program_.variable_upper(), push);
  const auto rows = static_cast<Eigen::Index>(program_.constraint_count());
  if (!inequalities_.empty()) {
    Eigen::VectorXd at_start(rows);
    program_.constraints(point.x, at_start);
    point.s = at_start(inequalities_);
    push_inside(point.s, program_.constraint_lower()(inequalities_), program_.constraint_upper()(inequalities_), push);
  }
  set_zero(point.multipliers, rows);
  point.x_lower.setOnes(x_lower_.values.size());
  point.x_upper.setOnes(x_upper_.values.size());
  point.s_lower.setOnes(s_lower_.values.size());
  point.s_upper.setOnes(s_upper_.values.size());
  return point;
}

void BarrierProgram::balance_bounds(double mu, Point& point) const {
  Eigen::VectorXd slope;
  static_cast<void>(slope_of_lagrangian(point.multipliers, slope));  // whether it is finite is asked where it is used
  balance_slope(point.x, x_lower_, 1.0, mu, slope, point.x_lower);
  balance_slope(point.x, x_upper_, -1.0, mu, slope, point.x_upper);
  const Eigen::VectorXd slack_slope = slope_of_slacks(point.multipliers);
  balance_slope(point.s, s_lower_, 1.0, mu, slack_slope, point.s_lower);
  balance_slope(point.s, s_upper_, -1.0, mu, slack_slope, point.s_upper);
}

Eigen::VectorXd BarrierProgram::slope_of_slacks(const Eigen::VectorXd& multipliers) const {
  return -multipliers(inequalities_);
}

std::optional<BarrierProgram::Merit> BarrierProgram::evaluate(const Eigen::VectorXd& x, const Eigen::VectorXd& s,
                                                              Eigen::VectorXd& rows) {
  Merit merit{};
  merit.objective = program_.objective(x);
  program_.constraints(x, rows);
  if (values_.size() > 0) set_to_sum(rows, rows, -1.0, values_);
  for (std::size_t j = 0; j < inequalities_.size(); ++j) rows[inequalities_[j]] -= s[static_cast<Eigen::Index>(j)];
  merit.violation = sum_of_magnitudes(rows);
  if (!std::isfinite(merit.objective) || !std::isfinite(merit.violation)) return std::nullopt;
  return merit;
}

void BarrierProgram::differentiate(const Eigen::VectorXd& x) {
  program_.gradient(x, gradient_);
  program_.jacobian(x, jacobian_);
}

void BarrierProgram::evaluate_hessian(const Point& point) {
  program_.hessian(point.x, 1.0, point.multipliers, hessian_);
}

bool BarrierProgram::slope_of_lagrangian(const Eigen::VectorXd& multipliers, Eigen::VectorXd& result) const {
  copy_to(result, gradient_);
  slope_of_rows_.add(jacobian_, multipliers, result);
  return is_finite(result);
}

double BarrierProgram::barrier(const Point& point) const {
  return barrier_of(point.x, x_lower_, 1.0) + barrier_of(point.x, x_upper_, -1.0) + barrier_of(point.s, s_lower_, 1.0) +
         barrier_of(point.s, s_upper_, -1.0);
}

double BarrierProgram::complementarity(const Point& point, double mu) const {
  return std::max({complementarity_of(point.x, x_lower_, point.x_lower, 1.0, mu),
                   complementarity_of(point.x, x_upper_, point.x_upper, -1.0, mu),
                   complementarity_of(point.s, s_lower_, point.s_lower, 1.0, mu),
                   complementarity_of(point.s, s_upper_, point.s_upper, -1.0, mu)});
}

void BarrierProgram::keep_near_barrier(double mu, Point& point) const {
  keep_near(point.x, x_lower_, 1.0, mu, point.x_lower);
  keep_near(point.x, x_upper_, -1.0, mu, point.x_upper);
  keep_near(point.s, s_lower_, 1.0, mu, point.s_lower);
  keep_near(point.s, s_upper_, -1.0, mu, point.s_upper);
}

}  // namespace dmocbench::interior_point
