#include "methods/extensions/step_control/step_control_map.hpp"

#include <span>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/extensions/step_control/extended_action.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/derivatives/local_functions.hpp"

namespace dmocbench {

namespace {

/// The inputs of an interval, numbered in this order.
struct ControlledInterval {
  ExpressionVector left_q;
  ExpressionVector right_q;
  std::vector<ExpressionVector> rates;
  Expression h;
  std::vector<ExpressionVector> controls;
  Expression pace;
  Expression t;
  ExpressionVector p;
  Expression time_momentum;  // -E_0

  ControlledInterval(Eigen::Index n, Eigen::Index m, Eigen::Index stages) {
    InputCounter counter;
    left_q = counter.take(n);
    right_q = counter.take(n);
    for (Eigen::Index j = 0; j + 1 < stages; ++j) rates.push_back(counter.take(n));
    h = counter.take();
    for (Eigen::Index i = 0; i < stages; ++i) controls.push_back(counter.take(m));
    pace = counter.take();
    t = counter.take();
    p = counter.take(n);
    time_momentum = counter.take();
  }
  [[nodiscard]] IntervalUnknowns of_element() const {
    IntervalUnknowns unknowns;
    unknowns.left_q = left_q;
    unknowns.right_q = right_q;
    unknowns.rates_q = rates;
    unknowns.controls = controls;
    unknowns.h = h;
    unknowns.t = t;
    return unknowns;
  }
  /// The state at the left node, with the mean velocity.
  [[nodiscard]] ControlledState left() const { return {left_q, (right_q - left_q) / h, controls.front(), t}; }
};

ExpressionVector one(const Expression& entry) { return ExpressionVector::Constant(1, entry); }

}  // namespace

StepControlMap::StepControlMap(const Problem& problem, const Tableau& tableau, const StepFunction& sigma, StepRule rule)
    : n_(problem.configuration_size()), interior_(tableau.stages() - 1), unknowns_(n_ * (interior_ + 1) + 1) {
  const TracedProblem traced(problem);
  const ControlledInterval in(n_, problem.control_size(), tableau.stages());
  const ExtendedAction action(problem, traced, tableau, in.of_element());
  const Expression on_left = sigma(in.left());
  if (rule == StepRule::from_left) {
    for (const Expression& by_right : gradient(on_left, in.right_q)) {
      if (!by_right.is_zero())
        throw Error("a step size that is computed before the step cannot depend on the velocity");
    }
  }
  sigma_ = Schedule(one(on_left));
  const Expression c = in.h - in.pace * (rule == StepRule::from_left ? on_left : action.mean_of(sigma));

  const ExpressionVector times = stacked({one(in.t), one(in.h)});
  Expression multiplier;
  if (rule == StepRule::variational) {
    const ExpressionVector unconstrained = action.variation_by(times, c, 0.0);
    const ExpressionVector c_by_times = gradient(c, times);
    multiplier = (unconstrained[0] + in.time_momentum - unconstrained[1]) / (c_by_times[1] - c_by_times[0]);
  }
  const ExpressionVector left = action.variation_by(in.left_q, c, multiplier);
  const ExpressionVector right = action.variation_by(in.right_q, c, multiplier);
  std::vector<ExpressionVector> rows{ExpressionVector(in.p + left)};
  for (std::size_t j = 0; j < in.rates.size(); ++j) {
    const Expression weight = in.h * Expression(tableau.b[static_cast<Eigen::Index>(j)]);  // as in `DmocElement`
    rows.emplace_back(action.variation_by(in.rates[j], c, multiplier) / weight);
  }
  rows.push_back(one(c));
  const ExpressionVector equations = stacked(rows);
  newton_ = TracedNewton<double>(equations, static_cast<std::size_t>(n_), unknowns_);
  const Expression last_time_momentum = in.time_momentum + action.variation_by(times, c, multiplier)[0];
  reading_ =
      Schedule(stacked({right, action.impulse(), one(action.torque()), one(last_time_momentum), one(multiplier)}));

  const ExpressionVector w = input_vector(static_cast<std::size_t>(n_), unknowns_);
  const ExpressionVector start = stacked({in.left_q, one(in.t), in.p, one(in.time_momentum)});
  const ExpressionVector end = stacked({in.right_q, one(in.t + in.h), right, one(last_time_momentum)});
  std::vector<Expression> derivatives;
  for (const ExpressionVector& formulas : {equations, end}) {
    for (const ExpressionVector& x : {w, start}) append(derivatives, dmocbench::jacobian(formulas, x));
  }
  derivatives_ = Schedule(derivatives);
}

StepControlMap::Step StepControlMap::advance(const From& from, const Eigen::MatrixXd& controls, double pace) const {
  Step step;
  std::vector<double>& inputs = step.inputs;
  const auto add = [&inputs](const Eigen::VectorXd& values) {
    inputs.insert(inputs.end(), values.begin(), values.end());
  };
  add(from.q);
  add(from.q + pace * from.velocity);  // σ = 1 until it is known; the velocity is the same then
  for (Eigen::Index j = 0; j < interior_; ++j) add(from.velocity);
  inputs.push_back(pace);
  for (Eigen::Index i = 0; i < controls.rows(); ++i) add(controls.row(i).transpose());
  inputs.push_back(pace);
  inputs.push_back(from.t);
  add(from.p);
  inputs.push_back(-from.energy);
  const double sigma = replay<double>(sigma_, std::span<const double>(inputs)).front();
  require_positive_step(sigma, from.t);
  const Eigen::Index place_of_h = n_ + unknowns_ - 1;
  double& h = inputs[static_cast<std::size_t>(place_of_h)];
  h = pace * sigma;
  Eigen::Map<Eigen::VectorXd>(inputs.data() + n_, n_) = from.q + h * from.velocity;
  newton_.solve(inputs);
  require_positive_step(h / pace, from.t);

  OutputBlocks<double> blocks(reading_, inputs);
  step.h = h;
  step.end.q = Eigen::Map<const Eigen::VectorXd>(inputs.data() + n_, n_);
  step.end.p = blocks.take(n_);
  step.end.t = from.t + h;
  step.impulse = blocks.take(n_);
  step.torque = blocks.take(1)(0, 0);
  step.end.energy = -blocks.take(1)(0, 0);
  step.multiplier = blocks.take(1)(0, 0);
  step.end.velocity = (step.end.q - from.q) / h;
  return step;
}

Eigen::MatrixXd StepControlMap::jacobian(const Step& step) const {
  const Eigen::Index size = 2 * n_ + 2;
  OutputBlocks<double> blocks(derivatives_, step.inputs);
  const Eigen::MatrixXd equations_by_unknowns = blocks.take(unknowns_, unknowns_);
  const Eigen::MatrixXd equations_by_start = blocks.take(unknowns_, size);
  const Eigen::MatrixXd end_by_unknowns = blocks.take(size, unknowns_);
  const Eigen::MatrixXd end_by_start = blocks.take(size, size);
  const Eigen::MatrixXd unknowns_by_start = solve_square(equations_by_unknowns, equations_by_start);
  return end_by_start - end_by_unknowns.lazyProduct(unknowns_by_start);
}

}  // namespace dmocbench
