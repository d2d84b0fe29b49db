#include "methods/transcription/interval_functions.hpp"

#include "methods/expression/derivatives.hpp"

namespace dmocbench {

namespace {

/// Hands out consecutive inputs.
class InputCounter {
 public:
  ExpressionVector take(Eigen::Index count) {
    ExpressionVector inputs = input_vector(next_, count);
    next_ += static_cast<std::size_t>(count);
    return inputs;
  }
  [[nodiscard]] std::size_t taken() const { return next_; }

 private:
  std::size_t next_ = 0;
};

IntervalUnknowns make_unknowns(Eigen::Index n, Eigen::Index m, NodeState node_state, Eigen::Index stages,
                               IntervalInputs& inputs) {
  const Eigen::Index second = node_state == NodeState::configuration ? 0 : n;
  InputCounter counter;
  IntervalUnknowns unknowns;
  unknowns.left_q = counter.take(n);
  unknowns.left_y = counter.take(second);
  unknowns.right_q = counter.take(n);
  unknowns.right_y = counter.take(second);
  for (Eigen::Index j = 0; j + 1 < stages; ++j) unknowns.slopes_q.push_back(counter.take(n));
  for (Eigen::Index j = 0; j + 1 < stages && second > 0; ++j) unknowns.slopes_y.push_back(counter.take(n));
  for (Eigen::Index i = 0; i < stages; ++i) unknowns.controls.push_back(counter.take(m));
  inputs.unknowns = counter.taken();
  unknowns.h = Expression::input(inputs.step());
  unknowns.t = Expression::input(inputs.time());
  return unknowns;
}

ExpressionVector stacked(const std::vector<ExpressionVector>& parts) {
  Eigen::Index size = 0;
  for (const ExpressionVector& part : parts) size += part.size();
  ExpressionVector all(size);
  Eigen::Index next = 0;
  for (const ExpressionVector& part : parts) {
    all.segment(next, part.size()) = part;
    next += part.size();
  }
  return all;
}

LocalVector nonzeros(const ExpressionVector& dense) {
  LocalVector vector;
  std::vector<Expression> entries;
  for (Eigen::Index i = 0; i < dense.size(); ++i) {
    if (dense[i].is_zero()) continue;
    entries.push_back(dense[i]);
    vector.places.push_back(static_cast<std::size_t>(i));
  }
  vector.schedule = Schedule(entries);
  return vector;
}

LocalMatrix nonzeros(const ExpressionMatrix& dense, bool lower_triangle) {
  LocalMatrix matrix;
  std::vector<Expression> entries;
  for (Eigen::Index i = 0; i < dense.rows(); ++i) {
    for (Eigen::Index j = 0; j < (lower_triangle ? i + 1 : dense.cols()); ++j) {
      if (dense(i, j).is_zero()) continue;
      entries.push_back(dense(i, j));
      matrix.rows.push_back(static_cast<std::size_t>(i));
      matrix.columns.push_back(static_cast<std::size_t>(j));
    }
  }
  matrix.schedule = Schedule(entries);
  return matrix;
}

}  // namespace

IntervalFunctions trace_interval(const TracedProblem& problem, const Element& element, const Tableau& tableau,
                                 double cost_scale) {
  IntervalFunctions functions;
  IntervalInputs& inputs = functions.inputs;
  const NodeState node_state = element.node_state();
  const IntervalUnknowns unknowns =
      make_unknowns(problem.configuration_size(), problem.control_size(), node_state, tableau.stages(), inputs);
  const IntervalTrace trace = element.trace(problem, tableau, unknowns);
  functions.node_rows = trace.left_rows.size();
  functions.private_rows = trace.private_rows.size();

  const ExpressionVector z = input_vector(0, static_cast<Eigen::Index>(inputs.unknowns));
  const ExpressionVector rows = stacked({trace.left_rows, trace.right_rows, trace.private_rows});
  inputs.rows = static_cast<std::size_t>(rows.size());
  const Expression cost = Expression(cost_scale) * trace.cost;
  Expression lagrangian = Expression::input(inputs.objective_factor()) * cost;
  for (std::size_t r = 0; r < inputs.rows; ++r) {
    lagrangian += Expression::input(inputs.multiplier(r)) * rows[static_cast<Eigen::Index>(r)];
  }

  functions.cost = Schedule(std::vector<Expression>{cost});
  functions.gradient = nonzeros(gradient(cost, z));
  functions.rows = nonzeros(rows);
  functions.jacobian = nonzeros(jacobian(rows, z), false);
  functions.lagrangian = Schedule(std::vector<Expression>{lagrangian});
  functions.hessian = nonzeros(hessian(lagrangian, z), true);
  const Eigen::Index node_size = unknowns.left_q.size() + unknowns.left_y.size();
  functions.node_adjoint = Schedule(gradient(lagrangian, z.head(2 * node_size)));
  functions.momenta = Schedule(stacked({trace.left_momentum, trace.right_momentum}));
  std::vector<ExpressionVector> stages;
  for (const ControlledState& stage : trace.stages) {
    stages.push_back(stage.q);
    stages.push_back(stage.v);
    stages.emplace_back(ExpressionVector::Constant(1, stage.t));
  }
  functions.stages = Schedule(stacked(stages));
  return functions;
}

}  // namespace dmocbench
