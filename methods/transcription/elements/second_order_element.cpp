#include "methods/transcription/elements/second_order_element.hpp"

#include <vector>

#include "methods/transcription/elements/polynomial_rates.hpp"

namespace dmocbench {

Tableau SecondOrderElement::rates(const Tableau& tableau) const {
  const int points = static_cast<int>(tableau.stages()) + 1;
  return collocation_tableau("gauss", gauss_nodes(points), 2 * points);
}

IntervalTrace SecondOrderElement::trace(const TracedProblem& problem, const Tableau& tableau,
                                        const IntervalUnknowns& unknowns) const {
  const Expression& h = unknowns.h;
  const Tableau points = rates(tableau);
  const auto rates_q = stage_rates(unknowns.left_q, unknowns.right_q, unknowns.rates_q, points.b, h);
  const auto configurations = stage_values(unknowns.left_q, rates_q, integrals_to(tableau.c, points), h);
  const ExpressionVector at_rest(unknowns.left_q.size());
  const auto accelerations = stage_values(at_rest, rates_q, derivatives_at(tableau.c, points), Expression(1.0) / h);

  IntervalTrace trace;
  std::vector<TracedProblem::Values> values;
  std::vector<ExpressionVector> equations;
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    const double tau = tableau.c[static_cast<Eigen::Index>(i)];
    const ExpressionVector velocity = polynomial_at(points.c, rates_q, tau);
    trace.stages.push_back(
        {configurations[i], velocity, unknowns.controls[i], unknowns.t + Expression(tau) * h, unknowns.stage_y(i)});
    values.push_back(problem.at(trace.stages.back()));
    ExpressionVector momentum_rate = values[i].mass * accelerations[i] + values[i].momentum_by_time;
    momentum_rate += values[i].momentum_by_configuration * velocity;
    if (problem.first_order_size() > 0) momentum_rate += values[i].momentum_by_first_order * unknowns.rates_y[i];
    equations.emplace_back(h * (momentum_rate - values[i].generalised_force));
  }
  trace.stage_equations = stacked(equations);
  trace.cost = quadrature_of_cost(values, tableau.b, h);
  const State left{unknowns.left_q, polynomial_at(points.c, rates_q, 0.0), unknowns.t, unknowns.left_y};
  const State right{unknowns.right_q, polynomial_at(points.c, rates_q, 1.0), unknowns.t + h, unknowns.right_y};
  trace.left_momentum = problem.at(left).momentum;
  trace.right_momentum = problem.at(right).momentum;
  trace.left_rows = -trace.left_momentum;
  trace.right_rows = trace.right_momentum;
  return trace;
}

}  // namespace dmocbench
