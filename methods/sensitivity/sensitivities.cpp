#include "methods/sensitivity/sensitivities.hpp"

#include "methods/error.hpp"
#include "methods/judgement/linearised_conditions.hpp"
#include "methods/kkt/sparse_kkt.hpp"

namespace dmocbench {

namespace {

/// (above - below)/distance, 0 where both are the same, infinite ones among them.
Eigen::VectorXd difference_quotient(const Eigen::VectorXd& below, const Eigen::VectorXd& above, double distance) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(below.size());
  for (Eigen::Index i = 0; i < below.size(); ++i) {
    if (above[i] != below[i]) result[i] = (above[i] - below[i]) / distance;
  }
  return result;
}

}  // namespace

ProgramValues values_of(NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers) {
  Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  ProgramValues values{.objective = program.objective(primal),
                       .gradient = Eigen::VectorXd(primal.size()),
                       .constraints = Eigen::VectorXd(multipliers.size()),
                       .variable_lower = program.variable_lower(),
                       .variable_upper = program.variable_upper(),
                       .constraint_lower = program.constraint_lower(),
                       .constraint_upper = program.constraint_upper()};
  program.gradient(primal, values.gradient);
  program.constraints(primal, values.constraints);
  program.jacobian(primal, jacobian);
  program.jacobian_structure().for_each(
      [&](Eigen::Index e, int row, int column) { values.gradient[column] += jacobian[e] * multipliers[row]; });
  return values;
}

ProgramValues rate_of_change(const ProgramValues& below, const ProgramValues& above, double distance) {
  const auto rate = [&](Eigen::VectorXd ProgramValues::*part) {
    return difference_quotient(below.*part, above.*part, distance);
  };
  return {.objective = (above.objective - below.objective) / distance,
          .gradient = rate(&ProgramValues::gradient),
          .constraints = rate(&ProgramValues::constraints),
          .variable_lower = rate(&ProgramValues::variable_lower),
          .variable_upper = rate(&ProgramValues::variable_upper),
          .constraint_lower = rate(&ProgramValues::constraint_lower),
          .constraint_upper = rate(&ProgramValues::constraint_upper)};
}

struct Sensitivities::Optimum {
  NonlinearProgram& program;
  LinearisedConditions at;
  Eigen::VectorXd multipliers;
  Eigen::VectorXd variable_lower;
  Eigen::VectorXd variable_upper;
  Eigen::VectorXd constraint_lower;
  Eigen::VectorXd constraint_upper;
  std::unique_ptr<kkt::KktSystem> system;

  Optimum(NonlinearProgram& of, const Eigen::VectorXd& primal, const Eigen::VectorXd& lambda)
      : program(of),
        at(of, primal, lambda),
        multipliers(lambda),
        variable_lower(of.variable_lower()),
        variable_upper(of.variable_upper()),
        constraint_lower(of.constraint_lower()),
        constraint_upper(of.constraint_upper()),
        system(kkt_system_of_any_point(of)) {}

  [[nodiscard]] bool is_fixed(Eigen::Index j) const { return variable_lower[j] == variable_upper[j]; }
  /// The rate of the bound that the gradient presses a variable against.
  [[nodiscard]] double bound_rate(const ProgramValues& rate, Eigen::Index j) const {
    return at.gradient_of_lagrangian[j] > 0.0 ? rate.variable_lower[j] : rate.variable_upper[j];
  }
  /// The rates of a(ξ) less its active bound, at a fixed ξ; 0 of inequalities that take no part.
  [[nodiscard]] Eigen::VectorXd residual_rates(const ProgramValues& rate) const {
    Eigen::VectorXd rates = rate.constraints;
    for (Eigen::Index i = 0; i < rates.size(); ++i) {
      rates[i] -= multipliers[i] < 0.0 ? rate.constraint_lower[i] : rate.constraint_upper[i];
      if (at.compliance[i] == LinearisedConditions::no_part) rates[i] = 0.0;
    }
    return rates;
  }
  /// The rates at which fixed variables move; 0 of the others.
  [[nodiscard]] Eigen::VectorXd fixed_rates(const ProgramValues& rate) const {
    Eigen::VectorXd rates = Eigen::VectorXd::Zero(rate.gradient.size());
    for (Eigen::Index j = 0; j < rates.size(); ++j) {
      if (is_fixed(j)) rates[j] = rate.variable_lower[j];
    }
    return rates;
  }

  void solve(const Eigen::VectorXd& gradient, const Eigen::VectorXd& constraints, Sensitivity& result) const {
    if (system->solve(kkt_matrix_of(at), {gradient, constraints}, {result.primal, result.multipliers}) ==
        kkt::FactorisationStatus::solved) {
      return;
    }
    throw Error("the optimum has no sensitivities: the matrix of its optimality conditions is singular");
  }
};

Sensitivities::Sensitivities(NonlinearProgram& program, const Eigen::VectorXd& primal,
                             const Eigen::VectorXd& multipliers) {
  if (static_cast<std::size_t>(primal.size()) != program.variable_count() ||
      static_cast<std::size_t>(multipliers.size()) != program.constraint_count()) {
    throw Error("sensitivities need {} variables and {} multipliers, got {} and {}", program.variable_count(),
                program.constraint_count(), primal.size(), multipliers.size());
  }
  optimum_ = std::make_unique<Optimum>(program, primal, multipliers);
  if (!optimum_->at.is_finite()) throw Error("the optimum has no sensitivities: a derivative is not finite");
}

Sensitivities::~Sensitivities() = default;

Sensitivity Sensitivities::along(const ProgramValues& rate) {
  Optimum& optimum = *optimum_;
  const LinearisedConditions& at = optimum.at;
  const Eigen::VectorXd moved = optimum.fixed_rates(rate);
  const Eigen::VectorXd residuals = optimum.residual_rates(rate);
  Sensitivity result{.objective = rate.objective + optimum.multipliers.dot(residuals),
                     .primal = Eigen::VectorXd::Zero(moved.size()),
                     .multipliers = Eigen::VectorXd::Zero(residuals.size())};
  Eigen::VectorXd gradient = rate.gradient;
  Eigen::VectorXd constraints = residuals;
  for (Eigen::Index j = 0; j < moved.size(); ++j) {
    const double bound = optimum.is_fixed(j) ? moved[j] : optimum.bound_rate(rate, j);
    if (bound == 0.0) continue;
    result.objective += at.gradient_of_lagrangian[j] * bound;
    if (!optimum.is_fixed(j)) gradient[j] -= at.diagonal[j] * bound;
  }
  optimum.program.jacobian_structure().for_each(
      [&](Eigen::Index e, int row, int column) { constraints[row] += at.jacobian[e] * moved[column]; });
  optimum.program.hessian_structure().for_each([&](Eigen::Index e, int row, int column) {
    gradient[row] += at.hessian[e] * moved[column];
    if (row != column) gradient[column] += at.hessian[e] * moved[row];
  });
  optimum.solve(gradient, constraints, result);
  result.primal += moved;
  return result;
}

}  // namespace dmocbench
