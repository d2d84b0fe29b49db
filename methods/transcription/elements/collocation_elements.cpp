#include "methods/transcription/elements/collocation_elements.hpp"

namespace dmocbench {

std::string HamiltonianElement::description() const {
  return "collocation of Hamilton's equations on (q, p) by the symplectic partitioned Runge-Kutta method";
}

IntervalTrace HamiltonianElement::trace(const TracedProblem& problem, const Tableau& tableau,
                                        const IntervalUnknowns& unknowns) const {
  const Expression& h = unknowns.h;
  const auto rates_q = stage_rates(unknowns.left_q, unknowns.right_q, unknowns.rates_q, tableau.b, h);
  const auto rates_p = stage_rates(unknowns.left_second, unknowns.right_second, unknowns.rates_second, tableau.b, h);
  const auto configurations = stage_values(unknowns.left_q, rates_q, tableau.a, h);
  const auto momenta = stage_values(unknowns.left_second, rates_p, tableau.a_conjugate, h);

  IntervalTrace trace;
  const Eigen::Index n = problem.configuration_size();
  const auto stages = static_cast<Eigen::Index>(rates_q.size());
  trace.stage_equations.resize(2 * n * stages);
  std::vector<TracedProblem::Values> values;
  for (Eigen::Index row = 0; row < stages; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const Expression time = unknowns.t + Expression(tableau.c[row]) * h;
    trace.stages.push_back({configurations[i], rates_q[i], unknowns.controls[i], time, unknowns.stage_y(i)});
    values.push_back(problem.at(trace.stages.back()));
    trace.stage_equations.segment(2 * row * n, n) = momenta[i] - values[i].momentum;
    trace.stage_equations.segment((2 * row + 1) * n, n) = rates_p[i] - values[i].generalised_force;
  }
  trace.cost = quadrature_of_cost(values, tableau.b, h);
  trace.left_momentum = unknowns.left_second;
  trace.right_momentum = unknowns.right_second;
  return trace;
}

std::string TangentElement::description() const { return "collocation of the Euler-Lagrange equations on (q, v)"; }

IntervalTrace TangentElement::trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const {
  const Expression& h = unknowns.h;
  const auto rates_q = stage_rates(unknowns.left_q, unknowns.right_q, unknowns.rates_q, tableau.b, h);
  const auto rates_v = stage_rates(unknowns.left_second, unknowns.right_second, unknowns.rates_second, tableau.b, h);
  const auto configurations = stage_values(unknowns.left_q, rates_q, tableau.a, h);
  const auto velocities = stage_values(unknowns.left_second, rates_v, tableau.a, h);

  IntervalTrace trace;
  const Eigen::Index n = problem.configuration_size();
  const auto stages = static_cast<Eigen::Index>(rates_q.size());
  trace.stage_equations.resize(2 * n * stages);
  std::vector<TracedProblem::Values> values;
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
  }
  trace.cost = quadrature_of_cost(values, tableau.b, h);
  trace.left_momentum = problem.at(State{unknowns.left_q, unknowns.left_second, unknowns.t, unknowns.left_y}).momentum;
  trace.right_momentum =
      problem.at(State{unknowns.right_q, unknowns.right_second, unknowns.t + h, unknowns.right_y}).momentum;
  return trace;
}

}  // namespace dmocbench
