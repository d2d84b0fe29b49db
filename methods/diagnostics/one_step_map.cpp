#include "methods/diagnostics/one_step_map.hpp"

#include "methods/expression/derivatives.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

template <class Scalar>
OneStepMap<Scalar>::OneStepMap(const TracedProblem& problem, const Element& element, const Tableau& tableau)
    : n_(problem.configuration_size()),
      node_state_(element.node_state()),
      interior_(element.has_stage_unknowns() ? element.rates(tableau).stages() - 1 : 0) {
  problem.require_no_constraints("the map of one step");
  // Inputs: q_0; the unknowns w = (y_0, q_1, y_1, interior rates), y = p or v where nodes carry it; the stage controls;
  // h; t; p_0.
  InputCounter counter;
  IntervalUnknowns local = take_unknowns(counter, problem, element, tableau);
  unknowns_ =
      static_cast<Eigen::Index>(counter.taken()) - n_ - element.controls(tableau).stages() * problem.control_size();
  local.h = counter.take();
  local.t = counter.take();
  const ExpressionVector p_0 = counter.take(n_);

  const IntervalTrace trace = element.trace(problem, tableau, local);
  ExpressionVector residual(n_ + trace.stage_equations.size());
  residual << trace.left_momentum - p_0, trace.stage_equations;
  newton_ = TracedNewton<Scalar>(residual, static_cast<std::size_t>(n_), unknowns_);
  // The impulse is the virtual work along a translation, which moves every stage as it moves q_0.
  std::vector<std::vector<ConjugatePair>> pairs;
  pairs.reserve(trace.stages.size());
  for (const ControlledState& stage : trace.stages) {
    pairs.push_back({{local.left_q, problem.at(stage).control_force}});
  }
  std::vector<Expression> reading;
  append(reading, trace.right_momentum);
  append(reading, variation(local.left_q, pairs, tableau.b, local.h));
  reading_ = Schedule(reading);
  const ExpressionVector w = input_vector(static_cast<std::size_t>(n_), unknowns_);
  std::vector<Expression> derivatives;
  for (const ExpressionVector& formulas : {residual, trace.right_momentum}) {
    for (const ExpressionVector& x : {w, local.left_q}) append(derivatives, dmocbench::jacobian(formulas, x));
  }
  derivatives_ = Schedule(derivatives);
}

template <class Scalar>
typename OneStepMap<Scalar>::Step OneStepMap<Scalar>::advance(const Vector& q_0, const Vector& p_0,
                                                              const Vector& velocity, const Matrix& controls, Scalar h,
                                                              Scalar t) const {
  Step step;
  std::vector<Scalar>& inputs = step.inputs;
  const auto add = [&inputs](const auto& values) { inputs.insert(inputs.end(), values.begin(), values.end()); };
  const Vector second = node_state_ == NodeState::momentum ? p_0 : velocity;
  const bool has_second = node_state_ != NodeState::configuration;
  const Vector q_1 = q_0 + h * velocity;
  add(q_0);
  if (has_second) add(second);
  add(q_1);
  if (has_second) add(second);
  for (Eigen::Index j = 0; j < interior_; ++j) add(velocity);
  if (has_second) inputs.resize(inputs.size() + static_cast<std::size_t>(n_ * interior_), Scalar(0));
  for (Eigen::Index i = 0; i < controls.rows(); ++i) {
    for (Eigen::Index j = 0; j < controls.cols(); ++j) inputs.push_back(controls(i, j));
  }
  inputs.push_back(h);
  inputs.push_back(t);
  add(p_0);
  newton_.solve(inputs);

  OutputBlocks<Scalar> blocks(reading_, inputs);
  step.p = blocks.take(n_);
  step.impulse = blocks.take(n_);
  step.q = Eigen::Map<const Vector>(inputs.data() + (has_second ? 2 * n_ : n_), n_);
  step.mean_velocity = (step.q - q_0) / h;
  return step;
}

template <class Scalar>
typename OneStepMap<Scalar>::Matrix OneStepMap<Scalar>::jacobian(const Step& step) const {
  OutputBlocks<Scalar> blocks(derivatives_, step.inputs);
  const Matrix by_unknowns = blocks.take(unknowns_, unknowns_);
  Matrix by_start(unknowns_, 2 * n_);
  by_start.leftCols(n_) = blocks.take(unknowns_, n_);
  by_start.rightCols(n_).setZero();
  by_start.topRightCorner(n_, n_).diagonal().setConstant(Scalar(-1));  // R begins with left momentum - p_0
  const Matrix momentum_by_unknowns = blocks.take(n_, unknowns_);
  const Matrix momentum_by_left = blocks.take(n_, n_);
  const Matrix unknowns_by_start = -solve_square(by_unknowns, by_start);
  Matrix result(2 * n_, 2 * n_);
  result.topRows(n_) = unknowns_by_start.middleRows(node_state_ == NodeState::configuration ? 0 : n_, n_);
  // lazyProduct: the blocked product costs seconds of compile time and pays off only for large matrices.
  result.bottomRows(n_) = momentum_by_unknowns.lazyProduct(unknowns_by_start);
  result.bottomLeftCorner(n_, n_) += momentum_by_left;
  return result;
}

template class OneStepMap<double>;
template class OneStepMap<long double>;

}  // namespace dmocbench
