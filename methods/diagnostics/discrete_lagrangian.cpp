#include "methods/diagnostics/discrete_lagrangian.hpp"

#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/elements/dmoc_element.hpp"

namespace dmocbench {

DiscreteLagrangian::DiscreteLagrangian(const Problem& problem, const Tableau& tableau)
    : n_(problem.configuration_size()), stages_(tableau.stages()) {
  const TracedProblem traced(problem);
  traced.require_no_constraints("the discrete Lagrangian");
  InputCounter counter;  // q_0, q_1, the interior rates, the stage controls, h, t
  IntervalUnknowns unknowns = take_unknowns(counter, traced, DmocElement(), tableau);
  unknowns.h = counter.take();
  unknowns.t = counter.take();
  const IntervalTrace trace = DmocElement().trace(traced, tableau, unknowns);
  const ExpressionVector& equations = trace.stage_equations;
  const auto first_rate = static_cast<std::size_t>(2 * n_);
  const ExpressionVector rates = input_vector(first_rate, equations.size());
  interior_rates_ = TracedNewton<long double>(equations, first_rate, equations.size());

  Expression action;
  for (std::size_t i = 0; i < trace.stages.size(); ++i) {
    const Expression weight = unknowns.h * Expression(tableau.b[static_cast<Eigen::Index>(i)]);
    action += weight * problem.lagrangian(trace.stages[i].state());
  }
  std::vector<Expression> outputs{action};
  append(outputs, trace.left_rows);
  append(outputs, trace.right_rows);
  for (const ExpressionVector& x : {unknowns.left_q, unknowns.right_q, rates}) {
    append(outputs, work_of_control(traced, trace.stages, x, tableau.b, unknowns.h));
  }
  for (const ExpressionVector& x : {rates, unknowns.left_q, unknowns.right_q}) append(outputs, jacobian(equations, x));
  objects_ = Schedule(outputs);
}

DiscreteObjects DiscreteLagrangian::at(const LongVector& q_0, const LongVector& q_1, const LongMatrix& controls,
                                       long double h, long double t) const {
  std::vector<long double> inputs(q_0.begin(), q_0.end());
  inputs.insert(inputs.end(), q_1.begin(), q_1.end());
  const LongVector mean_rate = (q_1 - q_0) / h;
  for (Eigen::Index j = 0; j + 1 < stages_; ++j) inputs.insert(inputs.end(), mean_rate.begin(), mean_rate.end());
  for (Eigen::Index i = 0; i < controls.rows(); ++i) {
    for (Eigen::Index j = 0; j < controls.cols(); ++j) inputs.push_back(controls(i, j));
  }
  inputs.push_back(h);
  inputs.push_back(t);
  interior_rates_.solve(inputs);

  OutputBlocks<long double> blocks(objects_, inputs);
  const Eigen::Index interior = n_ * (stages_ - 1);
  DiscreteObjects objects;
  objects.lagrangian = blocks.take(1)(0, 0);
  objects.left_momentum = -blocks.take(n_);
  objects.right_momentum = blocks.take(n_);
  objects.left_force = blocks.take(n_);
  objects.right_force = blocks.take(n_);
  if (interior == 0) return objects;
  const LongVector work_of_rates = blocks.take(interior);
  // W[∂Q/∂Q̇]·dQ̇/dq with dQ̇/dq = -(∂R/∂Q̇)⁻¹ ∂R/∂q: one solve with the transposed matrix serves both ends.
  const LongMatrix rows_by_rates = blocks.take(interior, interior);
  const LongVector adjoint = solve_square(LongMatrix(rows_by_rates.transpose()), work_of_rates);
  const LongMatrix rows_by_left = blocks.take(interior, n_);
  const LongMatrix rows_by_right = blocks.take(interior, n_);
  objects.left_force -= rows_by_left.transpose() * adjoint;
  objects.right_force -= rows_by_right.transpose() * adjoint;
  return objects;
}

}  // namespace dmocbench
