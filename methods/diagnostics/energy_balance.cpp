#include "methods/diagnostics/energy_balance.hpp"

#include <algorithm>
#include <cmath>

#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

Energy::Energy(const Problem& problem)
    : function_(problem.configuration_size(), problem.control_size(),
                [&](const ControlledState& x) {
                  const TracedProblem::Values values = TracedProblem(problem).at(x);
                  ExpressionVector outputs(2);
                  outputs << values.momentum.dot(x.v) - problem.lagrangian(x.state()), values.control_force.dot(x.v);
                  return outputs;
                }),
      values_(2) {}

double Energy::energy(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t) {
  function_.evaluate(q, v, Eigen::VectorXd(), t, values_);
  return values_[0];
}

double Energy::power(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& u, double t) {
  function_.evaluate(q, v, u, t, values_);
  return values_[1];
}

EnergyBalance energy_balance(const Problem& problem, const Trajectory& trajectory) {
  Energy energy(problem);
  const auto at_node = [&](Eigen::Index k) {
    const MotionPoint node = trajectory.node(k);
    return energy.energy(node.q, node.v, trajectory.node_times[k]);
  };
  EnergyBalance balance;
  const double first = at_node(0);
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const double h = trajectory.step(k);
    for (Eigen::Index i = 0; i < trajectory.stages(); ++i) {
      const Eigen::Index row = k * trajectory.stages() + i;
      const MotionPoint stage = trajectory.stage(row);
      balance.work +=
          h * trajectory.tableau.b[i] * energy.power(stage.q, stage.v, stage.u, trajectory.stage_times[row]);
    }
    balance.change = at_node(k + 1) - first;
    balance.largest_gap = std::max(balance.largest_gap, std::abs(balance.change - balance.work));
    balance.largest_work = std::max(balance.largest_work, std::abs(balance.work));
  }
  return balance;
}

}  // namespace dmocbench
