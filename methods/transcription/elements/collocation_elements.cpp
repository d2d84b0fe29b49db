#include "methods/transcription/elements/collocation_elements.hpp"

#include "methods/error.hpp"
#include "methods/expression/vectors.hpp"
#include "methods/transcription/elements/dmoc_element.hpp"

namespace dmocbench {

namespace {

/// G H_p(q, p): by which rate the constraints leave 0 with the momentum p.
ExpressionVector hidden_constraint(const TracedProblem& problem, const State& at, const ExpressionVector& p) {
  const ExpressionVector none(at.q.size());  // v = 0
  const TracedProblem::Values values = problem.at(State{at.q, none, at.t, at.y});
  const ExpressionVector velocity =
      solve_symmetric(values.mass, p - values.momentum,
                      "hamiltonian does not support constraints g(q) = 0 where L_vv is singular; use dmoc");
  return problem.constraints_at(at.q, none).jacobian * velocity;
}

/// The same interval with the momenta of its nodes as unknowns.
IntervalTrace with_momenta(IntervalTrace trace, const IntervalUnknowns& unknowns) {
  trace.stage_equations =
      stacked({unknowns.left_second - trace.left_momentum, unknowns.right_second - trace.right_momentum});
  trace.left_rows = trace.right_rows = {};
  trace.left_momentum = unknowns.left_second;
  trace.right_momentum = unknowns.right_second;
  return trace;
}

}  // namespace

Eigen::Index HamiltonianElement::multipliers(const Tableau& tableau) const {
  if (tableau.stages() == 1) return 2;
  if (has_stages_at_nodes(tableau)) return tableau.stages();
  throw Error("hamiltonian supports constraints g(q) = 0 only with --tableau gauss --stages 1 or --tableau lobatto");
}

std::vector<bool> HamiltonianElement::velocity_multipliers(const Tableau& tableau) const {
  if (tableau.stages() == 1) return {true, true};
  throw Error("hamiltonian supports velocity_constraints only with --tableau gauss --stages 1");
}

IntervalTrace HamiltonianElement::trace(const TracedProblem& problem, const Tableau& tableau,
                                        const IntervalUnknowns& unknowns) const {
  if (problem.has_embedding()) return with_momenta(DmocElement().trace(problem, tableau, unknowns), unknowns);
  const Expression& h = unknowns.h;
  const auto rates_q = stage_rates(unknowns.left_q, unknowns.right_q, unknowns.rates_q, tableau.b, h);
  const std::vector<ExpressionVector>& multipliers = unknowns.multipliers;
  ExpressionVector left_p = unknowns.left_second;
  ExpressionVector right_p = unknowns.right_second;
  const bool has_impulses = !multipliers.empty() && rates_q.size() == 1;
  IntervalTrace trace;
  if (!multipliers.empty()) trace.left_impulse = trace.right_impulse = ExpressionVector(unknowns.left_q.size());
  if (has_impulses) {
    trace.left_impulse = 0.5 * h * constraint_force(problem, unknowns.left_q, multipliers[0]);
    trace.right_impulse = 0.5 * h * constraint_force(problem, unknowns.right_q, multipliers[1]);
    left_p += trace.left_impulse;
    right_p -= trace.right_impulse;
  }
  const auto rates_p = stage_rates(left_p, right_p, unknowns.rates_second, tableau.b, h);
  const auto configurations = stage_values(unknowns.left_q, rates_q, tableau.a, h);
  const auto momenta = stage_values(left_p, rates_p, tableau.a_conjugate, h);

  const Eigen::Index n = problem.configuration_size();
  const auto stages = static_cast<Eigen::Index>(rates_q.size());
  trace.stage_equations.resize(2 * n * stages);
  std::vector<TracedProblem::Values> values;
  std::vector<ExpressionVector> conditions;  // of constraints
  for (Eigen::Index row = 0; row < stages; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const Expression time = unknowns.t + Expression(tableau.c[row]) * h;
    trace.stages.push_back({configurations[i], rates_q[i], unknowns.controls[i], time, unknowns.stage_y(i)});
    values.push_back(problem.at(trace.stages.back()));
    trace.stage_equations.segment(2 * row * n, n) = momenta[i] - values[i].momentum;
    trace.stage_equations.segment((2 * row + 1) * n, n) = rates_p[i] - values[i].generalised_force;
    if (multipliers.empty() || has_impulses) continue;
    trace.stage_forces.push_back(constraint_force(problem, configurations[i], multipliers[i]));
    trace.stage_equations.segment((2 * row + 1) * n, n) -= trace.stage_forces.back();
    if (i > 0) conditions.push_back(problem.constraints_at(configurations[i], rates_q[i]).residual);
  }
  if (!multipliers.empty()) {
    if (has_impulses) {
      conditions.push_back(problem.constraints_at(unknowns.right_q, rates_q[0]).residual);
      conditions.push_back(velocity_conditions(problem, configurations[0], rates_q[0]));
    }
    const State right{unknowns.right_q, rates_q.back(), unknowns.t + h, unknowns.right_y};
    conditions.push_back(hidden_constraint(problem, right, unknowns.right_second));
    trace.stage_equations = stacked({trace.stage_equations, stacked(conditions)});
  }
  trace.cost = quadrature_of_cost(values, tableau.b, h);
  trace.left_momentum = unknowns.left_second;
  trace.right_momentum = unknowns.right_second;
  return trace;
}

Eigen::Index TangentElement::multipliers(const Tableau& tableau) const {
  const Eigen::Index s = tableau.stages();
  if (s > (has_stages_at_nodes(tableau) ? 3 : 2)) {
    throw Error(
        "tangent supports constraints g(q) = 0 with --tableau gauss --stages 1 or 2, or --tableau lobatto --stages 2 "
        "or 3");
  }
  return s == 1 ? 2 : s + 2;
}

std::vector<bool> TangentElement::velocity_multipliers(const Tableau& tableau) const {
  std::vector<bool> of_velocity(static_cast<std::size_t>(multipliers(tableau)), true);
  of_velocity[static_cast<std::size_t>(tableau.stages())] = false;  // μ
  return of_velocity;
}

IntervalTrace TangentElement::trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const {
  const Expression& h = unknowns.h;
  const std::vector<ExpressionVector>& multipliers = unknowns.multipliers;
  const auto s = static_cast<std::size_t>(tableau.stages());
  ExpressionVector right_q = unknowns.right_q;
  ExpressionVector right_v = unknowns.right_second;
  if (!multipliers.empty()) {
    const ExpressionVector middle = 0.5 * (unknowns.left_q + unknowns.right_q);
    right_q += h * constraint_force(problem, middle, multipliers[s]);
    if (s > 1) right_v += h * constraint_force(problem, middle, multipliers[s + 1]);
  }
  const auto rates_q = stage_rates(unknowns.left_q, right_q, unknowns.rates_q, tableau.b, h);
  const auto rates_v = stage_rates(unknowns.left_second, right_v, unknowns.rates_second, tableau.b, h);
  const auto configurations = stage_values(unknowns.left_q, rates_q, tableau.a, h);
  const auto velocities = stage_values(unknowns.left_second, rates_v, tableau.a, h);

  IntervalTrace trace;
  const Eigen::Index n = problem.configuration_size();
  const auto stages = static_cast<Eigen::Index>(rates_q.size());
  trace.stage_equations.resize(2 * n * stages);
  if (!multipliers.empty()) trace.left_impulse = trace.right_impulse = ExpressionVector(n);
  std::vector<TracedProblem::Values> values;
  std::vector<ExpressionVector> conditions;  // of constraints
  for (Eigen::Index row = 0; row < stages; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const Expression time = unknowns.t + Expression(tableau.c[row]) * h;
    trace.stages.push_back({configurations[i], velocities[i], unknowns.controls[i], time, unknowns.stage_y(i)});
    values.push_back(problem.at(trace.stages.back()));
    trace.stage_equations.segment(2 * row * n, n) = rates_q[i] - velocities[i];
    ExpressionVector momentum_rate = values[i].mass * rates_v[i] + values[i].momentum_by_time;
    momentum_rate += values[i].momentum_by_configuration * velocities[i];
    if (problem.first_order_size() > 0) momentum_rate += values[i].momentum_by_first_order * unknowns.rates_y[i];
    trace.stage_equations.segment((2 * row + 1) * n, n) = momentum_rate - values[i].generalised_force;
    if (multipliers.empty()) continue;
    trace.stage_forces.push_back(constraint_force(problem, configurations[i], multipliers[i]));
    trace.stage_equations.segment((2 * row + 1) * n, n) -= trace.stage_forces.back();
    const TracedProblem::ConstraintValues at = problem.constraints_at(configurations[i], velocities[i]);
    if (s > 1) conditions.emplace_back(at.jacobian * rates_v[i] + at.curvature);
  }
  if (!multipliers.empty()) {
    const TracedProblem::ConstraintValues right = problem.constraints_at(unknowns.right_q, unknowns.right_second);
    conditions.push_back(right.residual);
    // In the order of the multipliers: λ_1 if it serves this one, otherwise ν, after μ.
    conditions.insert(s > 1 ? conditions.end() : conditions.begin(), right.jacobian * unknowns.right_second);
    trace.stage_equations = stacked({trace.stage_equations, stacked(conditions)});
  }
  trace.cost = quadrature_of_cost(values, tableau.b, h);
  trace.left_momentum = problem.at(State{unknowns.left_q, unknowns.left_second, unknowns.t, unknowns.left_y}).momentum;
  trace.right_momentum =
      problem.at(State{unknowns.right_q, unknowns.right_second, unknowns.t + h, unknowns.right_y}).momentum;
  return trace;
}

}  // namespace dmocbench
