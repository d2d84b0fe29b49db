#include "methods/transcription/elements/dmoc_element.hpp"

#include "methods/error.hpp"

namespace dmocbench {

Eigen::Index DmocElement::multipliers(const Tableau& tableau) const {
  if (tableau.stages() == 1) return 1;
  if (has_stages_at_nodes(tableau)) return tableau.stages() - 1;
  throw Error("dmoc supports constraints g(q) = 0 only with --tableau gauss --stages 1 or --tableau lobatto");
}

std::vector<bool> DmocElement::velocity_multipliers(const Tableau& tableau) const {
  if (tableau.stages() == 1) return {true};
  throw Error("dmoc supports velocity_constraints only with --tableau gauss --stages 1");
}

IntervalTrace DmocElement::trace(const TracedProblem& problem, const Tableau& tableau,
                                 const IntervalUnknowns& unknowns) const {
  const ExpressionVector left = problem.in_stages(unknowns.left_q, unknowns.t);
  const ExpressionVector right = problem.in_stages(unknowns.right_q, unknowns.t + unknowns.h);
  const auto rates = stage_rates(left, right, unknowns.rates_q, tableau.b, unknowns.h);
  const auto configurations = stage_values(left, rates, tableau.a, unknowns.h);
  return lagrange_d_alembert(problem, tableau, unknowns, {configurations, rates, unknowns.controls}, tableau.b);
}

IntervalTrace lagrange_d_alembert(const TracedProblem& problem, const Tableau& tableau,
                                  const IntervalUnknowns& unknowns, const StagePath& path,
                                  const Eigen::VectorXd& rate_weights) {
  const Expression& h = unknowns.h;
  const auto& [configurations, rates, controls] = path;

  IntervalTrace trace;
  std::vector<TracedProblem::Values> values;
  std::vector<ExpressionVector> conditions;       // g = 0
  std::vector<std::vector<ConjugatePair>> pairs;  // L_q + f works along Q_i, L_v along Q̇_i
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const Expression time = unknowns.t + Expression(tableau.c[static_cast<Eigen::Index>(i)]) * h;
    trace.stages.push_back({configurations[i], rates[i], controls[i], time, unknowns.stage_y(i)});
    values.push_back(problem.of_stages().at(trace.stages.back()));
    pairs.push_back({{configurations[i], values[i].generalised_force}, {rates[i], values[i].momentum}});
    if (!unknowns.multipliers.empty() && rates.size() > 1) trace.stage_forces.emplace_back(configurations[i].size());
    if (i == 0 || i >= unknowns.multipliers.size()) continue;
    trace.stage_forces.back() = constraint_force(problem, configurations[i], unknowns.multipliers[i]);
    pairs.back().push_back({configurations[i], trace.stage_forces.back()});
    conditions.push_back(problem.constraints_at(configurations[i], rates[i]).residual);
  }
  const auto vary = [&](const ExpressionVector& x) { return variation(x, pairs, tableau.b, h); };
  trace.left_rows = vary(unknowns.left_q);
  trace.right_rows = vary(unknowns.right_q);
  const Eigen::Index n = problem.configuration_size();
  trace.stage_equations.resize(n * static_cast<Eigen::Index>(unknowns.rates_q.size()));
  for (std::size_t j = 0; j < unknowns.rates_q.size(); ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    trace.stage_equations.segment(row * n, n) = vary(unknowns.rates_q[j]) / (h * Expression(rate_weights[row]));
  }
  if (!unknowns.multipliers.empty()) {
    const Expression weight = h * Expression(rates.size() == 1 ? 0.5 : tableau.b[0]);
    trace.left_impulse = weight * constraint_force(problem, unknowns.left_q, unknowns.multipliers.front());
    trace.right_impulse = ExpressionVector(n);
    trace.left_rows += trace.left_impulse;
    conditions.push_back(problem.constraints_at(unknowns.right_q, rates.back()).residual);
    conditions.push_back(velocity_conditions(problem, configurations.front(), rates.front()));
    trace.stage_equations = stacked({trace.stage_equations, stacked(conditions)});
  }
  trace.cost = quadrature_of_cost(values, tableau.b, h);
  trace.left_momentum = -trace.left_rows;
  trace.right_momentum = trace.right_rows;
  return trace;
}

}  // namespace dmocbench
