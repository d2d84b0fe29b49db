#include "methods/diagnostics/conserved_quantities.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/phase_trajectories.hpp"

namespace dmocbench {

namespace {

/// The contribution of the integral constraints to the integrand of the cost.
Expression priced_integrals(const TracedProblem::Values& values, const Trajectory& trajectory) {
  if (trajectory.integral_prices.size() != values.integrands.size()) {
    throw Error(
        "the control Hamiltonian needs the multipliers of the integral constraints: use a solver with multipliers");
  }
  Expression sum;
  for (Eigen::Index i = 0; i < values.integrands.size(); ++i) {
    sum -= Expression(trajectory.integral_prices[i]) * values.integrands[i];
  }
  return sum;
}

/// p·ξ at the nodes, and the impulses of forces of constraint along ξ in the intervals.
struct AlongSymmetry {
  Eigen::VectorXd momenta;
  Eigen::VectorXd impulses;
};

AlongSymmetry along_symmetry(const TracedProblem& traced, const Trajectory& trajectory) {
  PointFunction generator(traced, [&](const ControlledState& x) { return traced.at(x).symmetry; });
  const Eigen::Index intervals = trajectory.intervals();
  AlongSymmetry result{Eigen::VectorXd(intervals + 1), Eigen::VectorXd::Zero(intervals)};
  const bool has_impulses = trajectory.left_impulses.size() > 0;
  Eigen::VectorXd direction(traced.configuration_size());
  for (Eigen::Index k = 0; k <= intervals; ++k) {
    generator.evaluate(trajectory.node(k), trajectory.node_times[k], direction);
    result.momenta[k] = trajectory.p.row(k).dot(direction);
    if (has_impulses && k > 0) result.impulses[k - 1] += trajectory.right_impulses.row(k - 1).dot(direction);
    if (has_impulses && k < intervals) result.impulses[k] += trajectory.left_impulses.row(k).dot(direction);
  }
  return result;
}

void summarise(MomentumConsistency& result, double change_at_switches) {
  result.largest = result.defects.lpNorm<Eigen::Infinity>();
  result.mean = result.defects.lpNorm<1>() / static_cast<double>(result.defects.size());
  result.total = std::abs(result.defects.sum() + change_at_switches);
}

/// The intervals of all phases that have the symmetry, and the changes at the switches between them.
MomentumConsistency consistency_of_phases(const PhasedProblem& problem, const Trajectory& trajectory) {
  const std::vector<PhaseTrajectory> parts = phase_trajectories(problem, trajectory);
  MomentumConsistency all;
  double change = 0.0;  // at switches
  std::vector<std::optional<std::pair<double, double>>> ends;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const SharedParameters parameters(problem, *problem.phases()[i].problem);
    const TracedProblem traced(*problem.phases()[i].problem);
    ends.emplace_back();
    if (!traced.has_symmetry()) continue;
    const MomentumConsistency own = momentum_consistency(*problem.phases()[i].problem, parts[i].motion);
    const Eigen::VectorXd momentum = along_symmetry(traced, parts[i].motion).momenta;
    ends.back() = std::pair(momentum[0], momentum[momentum.size() - 1]);
    if (i > 0 && ends[problem.preceding(i)]) change += momentum[0] - ends[problem.preceding(i)]->second;
    all.largest_force = std::max(all.largest_force, own.largest_force);
    all.defects.conservativeResize(all.defects.size() + own.defects.size());
    all.defects.tail(own.defects.size()) = own.defects;
  }
  summarise(all, change);
  return all;
}

}  // namespace

MomentumConsistency momentum_consistency(const Problem& problem, const Trajectory& trajectory) {
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  const TracedProblem traced(problem);
  if (!traced.has_symmetry()) {
    throw Error(problem.name() + " defines no symmetry, so it has no conserved momentum");
  }
  if (const PhasedProblem* const phased = problem.phased()) return consistency_of_phases(*phased, trajectory);
  PointFunction force_along(traced, [&](const ControlledState& x) {
    const TracedProblem::Values values = traced.at(x);
    const ExpressionVector transport = values.symmetry_jacobian * x.v;
    const Expression work = values.generalised_force.dot(values.symmetry) + values.momentum.dot(transport);
    return stacked({ExpressionVector::Constant(1, work), values.symmetry});
  });

  const auto [momentum, impulses] = along_symmetry(traced, trajectory);
  MomentumConsistency result;
  result.defects.resize(trajectory.intervals());
  Eigen::VectorXd force(1 + traced.configuration_size());  // along ξ, then ξ
  const Eigen::Index s = trajectory.stages();
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const double h = trajectory.step(k);
    double work = 0.0;
    for (Eigen::Index i = 0; i < s; ++i) {
      const Eigen::Index stage = k * s + i;
      force_along.evaluate(trajectory.stage(stage), trajectory.stage_times[stage], force);
      if (trajectory.stage_constraint_forces.rows() > 0) {
        force[0] += trajectory.stage_constraint_forces.row(stage).dot(force.tail(force.size() - 1));
      }
      work += h * trajectory.tableau.b[i] * force[0];
      result.largest_force = std::max(result.largest_force, std::abs(force[0]));
    }
    result.defects[k] = momentum[k + 1] - momentum[k] - work - impulses[k];
  }
  summarise(result, 0.0);
  return result;
}

CostateMomentum costate_momentum(const Problem& problem, const Trajectory& trajectory) {
  const TracedProblem traced(problem);
  if (!traced.has_symmetry()) throw Error(problem.name() + " defines no symmetry, so its costates have no momentum");
  if (!trajectory.has_costates()) throw Error("the momentum of costates needs a trajectory with costates");
  const Eigen::Index n = traced.configuration_size();
  PointFunction action(n, traced.control_size(), [&](const ControlledState& x) {
    const TracedProblem::Values values = traced.at(x);
    ExpressionVector outputs(n * (n + 1));  // ξ, then Dξ column by column
    outputs << values.symmetry, values.symmetry_jacobian.reshaped();
    return outputs;
  });
  Eigen::VectorXd outputs(n * (n + 1));
  CostateMomentum result;
  result.values.resize(trajectory.q.rows());
  double largest = 0.0;
  for (Eigen::Index k = 0; k < result.values.size(); ++k) {
    action.evaluate(trajectory.node(k), trajectory.node_times[k], outputs);
    const Eigen::Map<const Eigen::MatrixXd> jacobian(outputs.data() + n, n, n);
    const Eigen::ArrayXd on_q = trajectory.psi_q.row(k).transpose().array() * outputs.head(n).array();
    const Eigen::ArrayXd on_p =
        trajectory.psi_p.row(k).transpose().array() * (jacobian.transpose() * trajectory.p.row(k).transpose()).array();
    result.values[k] = on_q.sum() - on_p.sum();
    largest = std::max(largest, on_q.abs().sum() + on_p.abs().sum());
  }
  const double difference = result.values.maxCoeff() - result.values.minCoeff();
  result.spread = largest > 0.0 ? difference / largest : difference;
  return result;
}

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
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
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

Eigen::VectorXd control_hamiltonian(const Problem& problem, const Trajectory& trajectory) {
  if (!trajectory.has_costates()) throw Error("the control Hamiltonian needs costates: use a solver with multipliers");
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  const TracedProblem traced(problem);
  const Eigen::Index n = traced.configuration_size();
  const Eigen::Index l = traced.first_order_size();
  PointFunction rates(traced, [&](const ControlledState& x) {  // C, then ṗ, then ẏ
    const TracedProblem::Values values = traced.at(x);
    ExpressionVector outputs(1 + n + l);
    outputs << values.running_cost + priced_integrals(values, trajectory), values.generalised_force,
        values.first_order_rates;
    return outputs;
  });
  Eigen::VectorXd hamiltonian(trajectory.node_times.size());
  Eigen::VectorXd outputs(1 + n + l);
  for (Eigen::Index k = 0; k < hamiltonian.size(); ++k) {
    const double t = trajectory.node_times[k];
    const Eigen::Index interval = std::min(k, trajectory.intervals() - 1);
    MotionPoint point = trajectory.node(k);
    point.u = control_on_interval(trajectory, interval, t);
    rates.evaluate(point, t, outputs);
    hamiltonian[k] = outputs[0] + trajectory.psi_q.row(k).dot(trajectory.v.row(k)) +
                     trajectory.psi_p.row(k).dot(outputs.segment(1, n));
    if (l > 0) hamiltonian[k] += trajectory.psi_y.row(k).dot(outputs.tail(l));
  }
  return hamiltonian;
}

double free_horizon_residual(const Problem& problem, const Trajectory& trajectory) {
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  const Eigen::VectorXd hamiltonian = control_hamiltonian(problem, trajectory);
  const TracedProblem traced(problem);
  const Eigen::Index n = traced.configuration_size();
  PointFunction end_rates(traced, [&](const ControlledState& x) {  // ∂Φ/∂T at given v, then L_vt
    ExpressionVector rates(1 + n);
    rates << gradient(problem.final_cost(x.state()), ExpressionVector::Constant(1, x.t)), traced.at(x).momentum_by_time;
    return rates;
  });
  const Eigen::Index last = trajectory.intervals();
  Eigen::VectorXd rates(1 + n);
  end_rates.evaluate(trajectory.node(last), trajectory.node_times[last], rates);
  return hamiltonian[last] + rates[0] - trajectory.psi_p.row(last).dot(rates.tail(n));
}

}  // namespace dmocbench
