#include "methods/transcription/hamiltonian_element.hpp"

namespace dmocbench {

std::string HamiltonianElement::description() const {
  return "collocation of Hamilton's equations on (q, p) by the symplectic partitioned Runge-Kutta method";
}

IntervalTrace HamiltonianElement::trace(const TracedProblem& problem, const Tableau& tableau,
                                        const IntervalUnknowns& unknowns) const {
  const Expression& h = unknowns.h;
  const auto slopes_q = all_slopes(unknowns.left_q, unknowns.right_q, unknowns.slopes_q, tableau.b, h);
  const auto slopes_p = all_slopes(unknowns.left_y, unknowns.right_y, unknowns.slopes_y, tableau.b, h);
  const auto configurations = stage_values(unknowns.left_q, slopes_q, tableau.a, h);
  const auto momenta = stage_values(unknowns.left_y, slopes_p, tableau.a_conjugate, h);

  IntervalTrace trace;
  const Eigen::Index n = problem.configuration_size();
  const auto stages = static_cast<Eigen::Index>(slopes_q.size());
  trace.stage_equations.resize(2 * n * stages);
  std::vector<TracedProblem::Values> values;
  for (Eigen::Index row = 0; row < stages; ++row) {
    const auto i = static_cast<std::size_t>(row);
    const Expression time = unknowns.t + Expression(tableau.c[row]) * h;
    trace.stages.push_back({configurations[i], slopes_q[i], unknowns.controls[i], time});
    values.push_back(problem.at(trace.stages.back()));
    trace.stage_equations.segment(2 * row * n, n) = momenta[i] - values[i].momentum;
    trace.stage_equations.segment((2 * row + 1) * n, n) = slopes_p[i] - values[i].generalised_force;
  }
  trace.cost = quadrature_of_cost(values, tableau.b, h);
  trace.left_momentum = unknowns.left_y;
  trace.right_momentum = unknowns.right_y;
  return trace;
}

}  // namespace dmocbench
