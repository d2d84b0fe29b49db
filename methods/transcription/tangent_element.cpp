#include "methods/transcription/tangent_element.hpp"

namespace dmocbench {

std::string TangentElement::description() const { return "collocation of the Euler-Lagrange equations on (q, v)"; }

IntervalTrace TangentElement::trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const {
  const Expression& h = unknowns.h;
  const auto slopes_q = all_slopes(unknowns.left_q, unknowns.right_q, unknowns.slopes_q, tableau.b, h);
  const auto slopes_v = all_slopes(unknowns.left_y, unknowns.right_y, unknowns.slopes_y, tableau.b, h);
  const auto configurations = stage_values(unknowns.left_q, slopes_q, tableau.a, h);
  const auto velocities = stage_values(unknowns.left_y, slopes_v, tableau.a, h);

  IntervalTrace trace;
  const Eigen::Index n = problem.configuration_size();
  const auto stages = static_cast<Eigen::Index>(slopes_q.size());
  trace.stage_equations.resize(2 * n * stages);
  std::vector<TracedProblem::Values> values;
  for (Eigen::Index row = 0; row < stages; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const Expression time = unknowns.t + Expression(tableau.c[row]) * h;
    trace.stages.push_back({configurations[i], velocities[i], unknowns.controls[i], time});
    values.push_back(problem.at(trace.stages.back()));
    trace.stage_equations.segment(2 * row * n, n) = slopes_q[i] - velocities[i];
    ExpressionVector momentum_rate = values[i].mass * slopes_v[i] + values[i].momentum_by_time;
    momentum_rate += values[i].momentum_by_configuration * velocities[i];
    trace.stage_equations.segment((2 * row + 1) * n, n) = momentum_rate - values[i].generalised_force;
  }
  trace.cost = quadrature_of_cost(values, tableau.b, h);
  trace.left_momentum = problem.at(State{unknowns.left_q, unknowns.left_y, unknowns.t}).momentum;
  trace.right_momentum = problem.at(State{unknowns.right_q, unknowns.right_y, unknowns.t + h}).momentum;
  return trace;
}

}  // namespace dmocbench
