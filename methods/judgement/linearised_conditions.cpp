#include "methods/judgement/linearised_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/kkt/sparse_kkt.hpp"
#include "methods/runtime/long_vectors.hpp"

namespace dmocbench {

namespace {

/// The least distance to a bound by which a multiplier is divided.
constexpr double at_bound = 1e-10;

/// The distance from x to the bound that a gradient of this sign presses it against.
double distance_to_bound(double gradient, double x, double lower, double upper) {
  return gradient > 0.0 ? x - lower : upper - x;
}

}  // namespace

LinearisedConditions::LinearisedConditions(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                           const Eigen::VectorXd& multipliers) {
  KktMemory memory;
  evaluate_kkt(program, primal, multipliers, memory);
  compute(program, primal, multipliers, memory);
}

void LinearisedConditions::compute(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                   const Eigen::VectorXd& multipliers, const KktMemory& memory) {
  hessian.resize(static_cast<Eigen::Index>(program.hessian_structure().size()));
  program.hessian(primal, 1.0, multipliers, hessian);
  jacobian = memory.jacobian;
  gradient_of_cost = memory.gradient_of_cost;
  gradient_of_lagrangian = memory.gradient;
  gradient = memory.gradient;
  constraints = memory.constraints;
  diagonal.setZero(primal.size());
  compliance.setZero(multipliers.size());
  for (Eigen::Index j = 0; j < primal.size(); ++j) {
    linearise_bound(j, primal[j], program.variable_lower()[j], program.variable_upper()[j]);
  }
  for (Eigen::Index i = 0; i < constraints.size(); ++i) {
    linearise_constraint(i, multipliers[i], program.constraint_lower()[i], program.constraint_upper()[i]);
  }
}

bool LinearisedConditions::is_finite() const {
  return dmocbench::is_finite(hessian) && dmocbench::is_finite(jacobian) && dmocbench::is_finite(gradient);
}

void LinearisedConditions::linearise_bound(Eigen::Index j, double x, double lower, double upper) {
  const double distance = distance_to_bound(gradient[j], x, lower, upper);
  if (!std::isfinite(distance)) return;
  const double counted = std::max(distance, at_bound);
  diagonal[j] = std::abs(gradient[j]) / counted;
  gradient[j] *= distance / counted;
}

void LinearisedConditions::linearise_constraint(Eigen::Index i, double multiplier, double lower, double upper) {
  const double value = constraints[i];
  constraints[i] = value - (multiplier < 0.0 ? lower : upper);
  if (lower == upper) return;
  const double distance = std::max(distance_to_bound(-multiplier, value, lower, upper), at_bound);
  compliance[i] = std::min(distance / std::abs(multiplier), no_part);
  if (!(compliance[i] < no_part)) compliance[i] = no_part;  // also where the multiplier is 0
  if (compliance[i] == no_part) constraints[i] = 0.0;
}

std::unique_ptr<kkt::KktSystem> kkt_system_of(const NonlinearProgram& program) {
  if (auto by_intervals = kkt::IntervalKkt::make(program)) return std::move(*by_intervals);
  return kkt_system_of_any_point(program);
}

std::unique_ptr<kkt::KktSystem> kkt_system_of_any_point(const NonlinearProgram& program) {
  return std::make_unique<kkt::SparseKkt>(program, kkt::SparseKkt::Order::found, kkt::SparseKkt::Inertia::any);
}

}  // namespace dmocbench
