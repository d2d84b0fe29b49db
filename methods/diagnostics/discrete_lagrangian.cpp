#include "methods/diagnostics/discrete_lagrangian.hpp"

#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/dmoc_element.hpp"

namespace dmocbench {

/// Inputs: q_0, q_1, the interior rates, the stage controls, h, t.
struct DiscreteLagrangian::Formulas {
  Eigen::Index n;
  Eigen::Index stages;
  ExpressionVector stage_equations;
  std::vector<Expression> outputs;

  Formulas(const Problem& problem, const Tableau& tableau) : n(problem.configuration_size()), stages(tableau.stages()) {
    const TracedProblem traced(problem);
    InputCounter counter;
    IntervalUnknowns unknowns = take_unknowns(counter, traced, NodeState::configuration, stages);
    unknowns.h = counter.take();
    unknowns.t = counter.take();
    const IntervalTrace trace = DmocElement().trace(traced, tableau, unknowns);
    stage_equations = trace.stage_equations;

    const ExpressionVector rates = input_vector(static_cast<std::size_t>(2 * n), n * (stages - 1));
    const auto virtual_work = [&](const ExpressionVector& x) {
      return work_of_control(traced, trace.stages, x, tableau.b, unknowns.h);
    };
    Expression action;
    for (std::size_t i = 0; i < trace.stages.size(); ++i) {
      const Expression weight = unknowns.h * Expression(tableau.b[static_cast<Eigen::Index>(i)]);
      action += weight * problem.lagrangian(trace.stages[i].state());
    }
    outputs.push_back(action);
    append(outputs, trace.left_rows);
    append(outputs, trace.right_rows);
    append(outputs, virtual_work(unknowns.left_q));
    append(outputs, virtual_work(unknowns.right_q));
    append(outputs, virtual_work(rates));
    append(outputs, jacobian(stage_equations, rates));
    append(outputs, jacobian(stage_equations, unknowns.left_q));
    append(outputs, jacobian(stage_equations, unknowns.right_q));
  }
};

DiscreteLagrangian::DiscreteLagrangian(const Problem& problem, const Tableau& tableau)
    : DiscreteLagrangian(Formulas(problem, tableau)) {}

DiscreteLagrangian::DiscreteLagrangian(const Formulas& formulas)
    : n_(formulas.n),
      stages_(formulas.stages),
      interior_rates_(formulas.stage_equations, static_cast<std::size_t>(2 * n_), formulas.stage_equations.size()),
      objects_(formulas.outputs) {}

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

  const std::vector<long double> values = replay<long double>(objects_, std::span<const long double>(inputs));
  const Eigen::Index interior = n_ * (stages_ - 1);
  const long double* next = values.data();
  const auto take = [&next](Eigen::Index rows, Eigen::Index columns) {
    LongMatrix block = Eigen::Map<const LongMatrix>(next, rows, columns);
    next += rows * columns;
    return block;
  };
  DiscreteObjects objects;
  objects.lagrangian = take(1, 1)(0, 0);
  objects.left_momentum = -take(n_, 1);
  objects.right_momentum = take(n_, 1);
  objects.left_force = take(n_, 1);
  objects.right_force = take(n_, 1);
  if (interior == 0) return objects;
  const LongVector work_of_rates = take(interior, 1);
  // W[∂Q/∂Q̇]·dQ̇/dq with dQ̇/dq = -(∂R/∂Q̇)⁻¹ ∂R/∂q: one solve with the transposed matrix serves both ends.
  const LongMatrix rows_by_rates = take(interior, interior);
  const LongVector adjoint = solve_square(LongMatrix(rows_by_rates.transpose()), work_of_rates);
  const LongMatrix rows_by_left = take(interior, n_);
  const LongMatrix rows_by_right = take(interior, n_);
  objects.left_force -= rows_by_left.transpose() * adjoint;
  objects.right_force -= rows_by_right.transpose() * adjoint;
  return objects;
}

}  // namespace dmocbench
