#include "methods/mechanics/equations_of_motion.hpp"

#include "methods/error.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

EquationsOfMotion::EquationsOfMotion(const TracedProblem& problem)
    : n_(problem.configuration_size()),
      l_(problem.first_order_size()),
      c_(problem.constraint_count()),
      function_(problem,
                [&](const ControlledState& x) {
                  const TracedProblem::Values values = problem.at(x);
                  ExpressionVector right_hand_side = values.generalised_force - values.momentum_by_time;
                  right_hand_side -= values.momentum_by_configuration * x.v;
                  if (l_ > 0) right_hand_side -= values.momentum_by_first_order * values.first_order_rates;
                  ExpressionVector outputs(n_ + l_ + n_ * n_);
                  outputs << right_hand_side, values.first_order_rates, values.mass.reshaped();
                  if (c_ == 0) return outputs;
                  const TracedProblem::ConstraintValues holonomic = problem.constraints_at(x.q, x.v);
                  return stacked({outputs, -holonomic.curvature, holonomic.jacobian.reshaped()});
                }),
      values_(function_.output_count()) {}

Eigen::VectorXd EquationsOfMotion::acceleration(const Eigen::Ref<const Eigen::VectorXd>& q,
                                                const Eigen::Ref<const Eigen::VectorXd>& v,
                                                const Eigen::Ref<const Eigen::VectorXd>& u, double t,
                                                const Eigen::Ref<const Eigen::VectorXd>& y) {
  return solved(q, v, u, t, y).head(n_);
}

Eigen::VectorXd EquationsOfMotion::multipliers(const MotionPoint& point, double t) {
  return solved(point.q, point.v, point.u, t, point.y).tail(c_);
}

Eigen::VectorXd EquationsOfMotion::solved(const Eigen::Ref<const Eigen::VectorXd>& q,
                                          const Eigen::Ref<const Eigen::VectorXd>& v,
                                          const Eigen::Ref<const Eigen::VectorXd>& u, double t,
                                          const Eigen::Ref<const Eigen::VectorXd>& y) {
  function_.evaluate(q, v, u, t, values_, y);
  const auto mass = values_.segment(n_ + l_, n_ * n_).reshaped(n_, n_);
  std::optional<Eigen::VectorXd> result;
  if (c_ == 0) {
    result = solve_if_invertible(mass, values_.head(n_));
  } else {
    const auto holonomic = values_.tail(c_ + c_ * n_);
    Eigen::VectorXd right(n_ + c_);
    right << values_.head(n_), holonomic.head(c_);
    result = solve_if_invertible(saddle_matrix(mass, holonomic.tail(c_ * n_).reshaped(c_, n_)), right);
  }
  if (!result) throw Error("the Lagrangian is not regular: L_vv is singular on the trajectory");
  return *result;
}

void EquationsOfMotion::write_rate(const std::vector<double>& state, const Eigen::Ref<const Eigen::VectorXd>& u,
                                   double t, std::vector<double>& rate) {
  const Eigen::Map<const Eigen::VectorXd> q(state.data(), n_);
  const Eigen::Map<const Eigen::VectorXd> v(state.data() + n_, n_);
  Eigen::Map<Eigen::VectorXd>(rate.data(), n_) = v;
  const Eigen::Map<const Eigen::VectorXd> y(state.data() + 2 * n_, l_);
  Eigen::Map<Eigen::VectorXd>(rate.data() + n_, n_) = acceleration(q, v, u, t, y);
  Eigen::Map<Eigen::VectorXd>(rate.data() + 2 * n_, l_) = values_.segment(n_, l_);
}

}  // namespace dmocbench
