#include "methods/diagnostics/control_hamiltonian.hpp"

#include <algorithm>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/interpolation.hpp"

namespace dmocbench {

namespace {

/// ∂Φ/∂T at given velocities, then L_vt, at the last node.
Eigen::VectorXd end_rates(const Problem& problem, const Trajectory& trajectory) {
  const TracedProblem traced(problem);
  PointFunction rate(problem.configuration_size(), problem.control_size(), [&](const ControlledState& x) {
    ExpressionVector time(1);
    time << x.t;
    ExpressionVector rates(1 + problem.configuration_size());
    rates << gradient(problem.final_cost(x.state()), time), traced.at(x).momentum_by_time;
    return rates;
  });
  const Eigen::Index last = trajectory.intervals();
  Eigen::VectorXd value(1 + problem.configuration_size());
  rate.evaluate(trajectory.node(last), trajectory.node_times[last], value);
  return value;
}

}  // namespace

Eigen::VectorXd control_hamiltonian(const Problem& problem, const Trajectory& trajectory) {
  if (!trajectory.has_costates()) throw Error("the control Hamiltonian needs costates: a solver with multipliers");
  const TracedProblem traced(problem);
  const Eigen::Index n = traced.configuration_size();
  PointFunction rates(n, traced.control_size(), [&](const ControlledState& x) {  // C, then ṗ
    const TracedProblem::Values values = traced.at(x);
    ExpressionVector outputs(1 + n);
    outputs << values.running_cost, values.generalised_force;
    return outputs;
  });
  Eigen::VectorXd hamiltonian(trajectory.node_times.size());
  Eigen::VectorXd outputs(1 + n);
  for (Eigen::Index k = 0; k < hamiltonian.size(); ++k) {
    const double t = trajectory.node_times[k];
    const Eigen::Index interval = std::min(k, trajectory.intervals() - 1);
    MotionPoint point = trajectory.node(k);
    point.u = control_on_interval(trajectory, interval, t);
    rates.evaluate(point, t, outputs);
    hamiltonian[k] =
        outputs[0] + trajectory.psi_q.row(k).dot(trajectory.v.row(k)) + trajectory.psi_p.row(k).dot(outputs.tail(n));
  }
  return hamiltonian;
}

double free_horizon_residual(const Problem& problem, const Trajectory& trajectory) {
  const Eigen::VectorXd hamiltonian = control_hamiltonian(problem, trajectory);
  const Eigen::Index last = trajectory.intervals();
  const Eigen::VectorXd rates = end_rates(problem, trajectory);
  return hamiltonian[last] + rates[0] - trajectory.psi_p.row(last).dot(rates.tail(rates.size() - 1));
}

}  // namespace dmocbench
