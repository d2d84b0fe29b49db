#include "methods/transcription/dmoc_element.hpp"

#include "methods/expression/derivatives.hpp"

namespace dmocbench {

namespace {

/// ∂A/∂x + W[∂/∂x] for unknowns x (inputs) that the stages depend on: by the chain rule
/// h Σ b_i [(L_q + f)·∂Q_i/∂x + L_v·∂Q̇_i/∂x].
ExpressionVector variation(const ExpressionVector& x, const std::vector<ControlledState>& stages,
                           const std::vector<TracedProblem::Values>& values, const Eigen::VectorXd& b,
                           const Expression& h) {
  ExpressionVector sum(x.size());
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const Expression weight = h * Expression(b[static_cast<Eigen::Index>(i)]);
    const ExpressionMatrix by_configuration = weight * jacobian(stages[i].q, x).transpose();
    const ExpressionMatrix by_velocity = weight * jacobian(stages[i].v, x).transpose();
    sum += by_configuration * values[i].generalised_force;
    sum += by_velocity * values[i].momentum;
  }
  return sum;
}

}  // namespace

std::string DmocElement::description() const {
  return "Discrete Mechanics and Optimal Control: the discrete Lagrange-d'Alembert principle on q";
}

IntervalTrace DmocElement::trace(const TracedProblem& problem, const Tableau& tableau,
                                 const IntervalUnknowns& unknowns) const {
  const Expression& h = unknowns.h;
  const auto slopes = all_slopes(unknowns.left_q, unknowns.right_q, unknowns.slopes_q, tableau.b, h);
  const auto configurations = stage_values(unknowns.left_q, slopes, tableau.a, h);

  IntervalTrace trace;
  std::vector<TracedProblem::Values> values;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    const Expression time = unknowns.t + Expression(tableau.c[static_cast<Eigen::Index>(i)]) * h;
    trace.stages.push_back({configurations[i], slopes[i], unknowns.controls[i], time});
    values.push_back(problem.at(trace.stages.back()));
  }
  const auto vary = [&](const ExpressionVector& x) { return variation(x, trace.stages, values, tableau.b, h); };
  trace.left_rows = vary(unknowns.left_q);
  trace.right_rows = vary(unknowns.right_q);
  const Eigen::Index n = problem.configuration_size();
  trace.stage_equations.resize(n * static_cast<Eigen::Index>(unknowns.slopes_q.size()));
  for (std::size_t j = 0; j < unknowns.slopes_q.size(); ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    trace.stage_equations.segment(row * n, n) = vary(unknowns.slopes_q[j]) / (h * Expression(tableau.b[row]));
  }
  trace.cost = quadrature_of_cost(values, tableau.b, h);
  trace.left_momentum = -trace.left_rows;
  trace.right_momentum = trace.right_rows;
  return trace;
}

}  // namespace dmocbench
