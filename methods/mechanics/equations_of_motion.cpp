#include "methods/mechanics/equations_of_motion.hpp"

#include "methods/error.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

EquationsOfMotion::EquationsOfMotion(const TracedProblem& problem)
    : n_(problem.configuration_size()),
      function_(n_, problem.control_size(),
                [&](const ControlledState& x) {
                  const TracedProblem::Values values = problem.at(x);
                  ExpressionVector right_hand_side = values.generalised_force - values.momentum_by_time;
                  right_hand_side -= values.momentum_by_configuration * x.v;
                  ExpressionVector outputs(n_ + n_ * n_);
                  outputs << right_hand_side, values.mass.reshaped();
                  return outputs;
                }),
      values_(function_.output_count()) {}

Eigen::VectorXd EquationsOfMotion::acceleration(const Eigen::Ref<const Eigen::VectorXd>& q,
                                                const Eigen::Ref<const Eigen::VectorXd>& v,
                                                const Eigen::Ref<const Eigen::VectorXd>& u, double t) {
  function_.evaluate(q, v, u, t, values_);
  const std::optional<Eigen::VectorXd> acceleration =
      solve_if_invertible(values_.tail(n_ * n_).reshaped(n_, n_), values_.head(n_));
  if (!acceleration) throw Error("the Lagrangian is not regular: L_vv is singular on the motion");
  return *acceleration;
}

void EquationsOfMotion::write_rate(const std::vector<double>& state, const Eigen::Ref<const Eigen::VectorXd>& u,
                                   double t, std::vector<double>& rate) {
  const Eigen::Map<const Eigen::VectorXd> q(state.data(), n_);
  const Eigen::Map<const Eigen::VectorXd> v(state.data() + n_, n_);
  Eigen::Map<Eigen::VectorXd>(rate.data(), n_) = v;
  Eigen::Map<Eigen::VectorXd>(rate.data() + n_, n_) = acceleration(q, v, u, t);
}

}  // namespace dmocbench
