#include "methods/extensions/primitives/discrete_flow.hpp"

#include <vector>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/vectors.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

namespace {

/// The step as formulas of (q, v) and u.
class TracedStep {
 public:
  TracedStep(const Problem& problem, double h) : problem_(problem), h_(h) {
    InputCounter inputs;
    q_ = inputs.take(problem.configuration_size());
    v_ = inputs.take(problem.configuration_size());
    u_ = inputs.take(problem.control_size());
  }

  /// (q, v) at the end, then the cost, by a given number of Newton steps with the matrix L_vv.
  [[nodiscard]] ExpressionVector end(int newton_steps) const {
    const ExpressionVector p = at(q_, v_).momentum;
    ExpressionVector rate = v_;  // (q_{k+1} - q_k)/h
    for (int i = 0; i < newton_steps; ++i) {
      const TracedProblem::Values middle = at(middle_of(rate), rate);
      ExpressionVector residual = middle.momentum - p;
      residual -= Expression(0.5 * h_) * middle.generalised_force;
      rate -= solve_symmetric(middle.mass, residual);
    }
    const TracedProblem::Values middle = at(middle_of(rate), rate);
    const ExpressionVector last_q = q_ + Expression(h_) * rate;
    const ExpressionVector last_p = p + Expression(h_) * middle.generalised_force;
    ExpressionVector last_v = rate;
    for (int i = 0; i < newton_steps_of_velocity; ++i) {
      const TracedProblem::Values last = at(last_q, last_v);
      last_v -= solve_symmetric(last.mass, last.momentum - last_p);
    }
    ExpressionVector result(2 * q_.size() + 1);
    result << last_q, last_v, Expression(h_) * middle.running_cost;
    return result;
  }

  [[nodiscard]] ExpressionVector inputs() const {
    ExpressionVector all(2 * q_.size() + u_.size());
    all << q_, v_, u_;
    return all;
  }

 private:
  // One is exact where L is quadratic in the velocity.
  static constexpr int newton_steps_of_velocity = 2;

  [[nodiscard]] ExpressionVector middle_of(const ExpressionVector& rate) const {
    return q_ + Expression(0.5 * h_) * rate;
  }
  [[nodiscard]] TracedProblem::Values at(const ExpressionVector& q, const ExpressionVector& v) const {
    return problem_.at(ControlledState{q, v, u_, Expression(0.0)});
  }

  TracedProblem problem_;
  double h_;
  ExpressionVector q_;
  ExpressionVector v_;
  ExpressionVector u_;
};

Tape tape_of_derivatives(const TracedStep& step, Eigen::Index states) {
  constexpr int newton_steps = 3;
  const ExpressionMatrix derivatives = jacobian(step.end(newton_steps).head(states), step.inputs());
  return Tape(Schedule(ExpressionVector(derivatives.reshaped())));
}

}  // namespace

DiscreteFlow::DiscreteFlow(const Problem& problem, double h)
    : h_(h), n_(problem.configuration_size()), m_(problem.control_size()) {
  constexpr int newton_steps = 6;
  const TracedStep step(problem, h);
  map_ = Tape(Schedule(step.end(newton_steps)));
  derivatives_ = tape_of_derivatives(step, 2 * n_);
}

Eigen::MatrixXd DiscreteFlow::evaluated(const Tape& tape, const Eigen::MatrixXd& states,
                                        const Eigen::MatrixXd& controls) const {
  std::vector<Tape::Input> inputs;
  for (Eigen::Index i = 0; i < 2 * n_; ++i) inputs.push_back({states.col(i).data(), false});
  for (Eigen::Index i = 0; i < m_; ++i) inputs.push_back({controls.col(i).data(), false});
  return tape.table(states.rows(), inputs);
}

void DiscreteFlow::advance(Eigen::MatrixXd& states, const Eigen::MatrixXd& controls, Eigen::VectorXd& costs) const {
  const Eigen::MatrixXd results = evaluated(map_, states, controls);
  states = results.leftCols(2 * n_);
  costs += results.col(2 * n_);
}

Eigen::MatrixXd DiscreteFlow::derivatives(const Eigen::MatrixXd& states, const Eigen::MatrixXd& controls) const {
  return evaluated(derivatives_, states, controls);
}

}  // namespace dmocbench
