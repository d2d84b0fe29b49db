#include "methods/solvers/interior_point/barrier_program.hpp"

#include <algorithm>
#include <cmath>

#include "methods/kkt/linearisation.hpp"
#include "methods/runtime/long_vectors.hpp"

namespace dmocbench::interior_point {

namespace {

void push_inside(Eigen::VectorXd& vector, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double share) {
  for_each_bounded(lower, upper, [&](Eigen::Index i) {
    vector[i] = lower[i] == upper[i] ? lower[i] : pushed_inside(vector[i], lower[i], upper[i], share);
  });
}

/// Whether a variable that may move has a bound.
bool has_bounded_variables(const NonlinearProgram& program) {
  const Eigen::VectorXd& lower = program.variable_lower();
  const Eigen::VectorXd& upper = program.variable_upper();
  bool has_some = false;
  for_each_bounded(lower, upper, [&](Eigen::Index i) { has_some = has_some || lower[i] != upper[i]; });
  return has_some;
}

/// Eigen's own indexing copies the indices.
void select(const Eigen::VectorXd& from, const std::vector<Eigen::Index>& entries, Eigen::VectorXd& to) {
  to.resize(static_cast<Eigen::Index>(entries.size()));
  for (Eigen::Index j = 0; j < to.size(); ++j) to[j] = from[entries[static_cast<std::size_t>(j)]];
}

/// Bounds of the variables are left empty where none of them counts.
Primal bounds_of(const Eigen::VectorXd& variables, bool are_bounded, const Eigen::VectorXd& rows,
                 const std::vector<Eigen::Index>& inequalities) {
  Primal bounds;
  if (are_bounded) copy_to(bounds.x, variables);
  select(rows, inequalities, bounds.s);
  return bounds;
}

}  // namespace

BarrierProgram::BarrierProgram(NonlinearProgram& program)
    : program_(program),
      inequalities_(inequalities_of(program)),
      fixed_(fixed_variables(program)),
      has_bounded_variables_(has_bounded_variables(program)),
      lower_(bounds_of(program.variable_lower(), has_bounded_variables_, program.constraint_lower(), inequalities_)),
      upper_(bounds_of(program.variable_upper(), has_bounded_variables_, program.constraint_upper(), inequalities_)),
      bounds_(lower_, upper_),
      transposed_jacobian_(kkt::MatrixProduct::transposed(program.jacobian_structure())) {
  resize_unwritten(gradient_, static_cast<Eigen::Index>(program.variable_count()));
  resize_unwritten(jacobian_, static_cast<Eigen::Index>(program.jacobian_structure().size()));
  resize_unwritten(hessian_, static_cast<Eigen::Index>(program.hessian_structure().size()));
  read_bounds();
}

void BarrierProgram::read_bounds() {
  if (has_bounds()) {
    if (has_bounded_variables_) {
      copy_to(lower_.x, program_.variable_lower());
      copy_to(upper_.x, program_.variable_upper());
    }
    select(program_.constraint_lower(), inequalities_, lower_.s);
    select(program_.constraint_upper(), inequalities_, upper_.s);
    bounds_.read(lower_, upper_);
  }
  if (equality_values_.size() == 0 && largest_of(program_.constraint_lower()) == 0.0) return;
  copy_to(equality_values_, program_.constraint_lower());
  for (const Eigen::Index i : inequalities_) equality_values_[i] = 0.0;
}

void BarrierProgram::set_interior(const Eigen::VectorXd& start, double push, Iterate& at) {
  copy_to(at.x, start);
  push_inside(at.x, program_.variable_lower(), program_.variable_upper(), push);
  const auto constraints = static_cast<Eigen::Index>(program_.constraint_count());
  if (!inequalities_.empty()) {
    resize_unwritten(values_, constraints);
    program_.constraints(at.x, values_);
    select(values_, inequalities_, at.s);
    push_inside(at.s, lower_.s, upper_.s, push);
  }
  set_zero(at.multipliers, constraints);
  bounds_.set_multipliers(1.0, at.z);
}

bool BarrierProgram::evaluate(const Primal& at, double mu, Evaluation& result) {
  Eigen::VectorXd& constraints = result.constraints;
  resize_unwritten(constraints, static_cast<Eigen::Index>(program_.constraint_count()));
  result.objective = program_.objective(at.x);
  program_.constraints(at.x, constraints);
  if (equality_values_.size() > 0) set_to_sum(constraints, constraints, -1.0, equality_values_);
  for (Eigen::Index j = 0; j < at.s.size(); ++j) constraints[inequalities_[static_cast<std::size_t>(j)]] -= at.s[j];
  result.theta = sum_of_magnitudes(constraints);
  if (!std::isfinite(result.objective) || !std::isfinite(result.theta)) {
    result.theta = unbounded;
    return false;
  }
  result.phi = barrier_function(at, mu, result.objective);
  return true;
}

double BarrierProgram::barrier_function(const Primal& at, double mu, double objective) const {
  return objective + (has_bounds() ? mu * bounds_.barrier(at) : 0.0);
}

void BarrierProgram::differentiate(const Eigen::VectorXd& x) {
  program_.gradient(x, gradient_);
  program_.jacobian(x, jacobian_);
}

void BarrierProgram::evaluate_hessian(const Iterate& at) { program_.hessian(at.x, 1.0, at.multipliers, hessian_); }

bool BarrierProgram::gradient_of_lagrangian(const Eigen::VectorXd& multipliers, Primal& result) const {
  const bool is_usable = kkt::set_to_sum_of_products(
      result.x, gradient_, {{.matrix = transposed_jacobian_, .values = jacobian_, .vector = multipliers}});
  select(multipliers, inequalities_, result.s);
  result.s = -result.s;
  for (const Eigen::Index i : fixed_) result.x[i] = 0.0;
  return is_usable;
}

OptimalityErrors BarrierProgram::optimality_errors(const Iterate& at, const Primal& gradient,
                                                   const Evaluation& values) {
  OptimalityErrors errors;
  errors.violation = largest_of(values.constraints);
  double sum_z = 0.0;
  if (has_bounds()) {
    copy_to(balanced_.x, gradient.x);
    balanced_.s = gradient.s;
    bounds_.subtract_multipliers(at.z, balanced_);
    bounds_.find_products(at, at.z, errors.smallest_product, errors.largest_product);
    errors.stationarity = std::max(largest_of(balanced_.x), largest_of(balanced_.s));
    for (const Eigen::VectorXd& z : at.z) sum_z += z.sum();
    errors.mean_bound_multiplier = sum_z / static_cast<double>(bounds_.count());
  } else {
    errors.stationarity = largest_of(gradient.x);
  }
  const auto count = static_cast<double>(bounds_.count() + at.multipliers.size());
  if (count > 0.0) errors.mean_multiplier = (sum_of_magnitudes(at.multipliers) + sum_z) / count;
  return errors;
}

bool BarrierProgram::meets(const StopRule& rule, const OptimalityErrors& errors, const Iterate& at,
                           const Primal& gradient, const Evaluation& values) const {
  const Primal& with_bounds = has_bounds() ? balanced_ : gradient;
  return errors.meet(rule, values.constraints, at.multipliers, with_bounds.x, with_bounds.s);
}

}  // namespace dmocbench::interior_point
