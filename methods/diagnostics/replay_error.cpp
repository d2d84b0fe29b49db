#include "methods/diagnostics/replay_error.hpp"

#include <cmath>

#include <Eigen/Core>
#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/numerics/adaptive_integration.hpp"
#include "methods/transcription/interpolation.hpp"

namespace dmocbench {

namespace {

/// The state at an end: as prescribed, and the trajectory's where it is free.
BoundaryState end_state(const BoundaryState& prescribed, const EndBounds& bounds, const Trajectory& trajectory,
                        Eigen::Index node) {
  BoundaryState state = prescribed;
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    if (!bounds.q.is_fixed(i)) state.q[i] = trajectory.q(node, i);
    if (!bounds.v.is_fixed(i)) state.v[i] = trajectory.v(node, i);
  }
  return state;
}

/// Φ at the end of a motion.
double final_cost(const Problem& problem, const BoundaryState& last, double horizon) {
  PointFunction function(problem.configuration_size(), problem.control_size(), [&](const ControlledState& x) {
    return ExpressionVector::Constant(1, problem.final_cost(x.state()));
  });
  Eigen::VectorXd value(1);
  function.evaluate(last.q, last.v, Eigen::VectorXd(), horizon, value);
  return value[0];
}

}  // namespace

double ReplayError::norm() const { return std::hypot(configuration, velocity); }

ReplayError replay_error(const Problem& problem, const Trajectory& trajectory, double tolerance) {
  using PhaseVector = std::vector<double>;
  const TracedProblem traced(problem);
  EquationsOfMotion motion(traced);
  PointFunction running_cost(traced.configuration_size(), traced.control_size(), [&](const ControlledState& x) {
    return ExpressionVector::Constant(1, traced.at(x).running_cost);
  });
  const Eigen::Index n = problem.configuration_size();
  const Eigen::Index intervals = trajectory.intervals();
  const ProblemBounds bounds = problem.bounds();
  const BoundaryState first = end_state(problem.initial_state(), bounds.first, trajectory, 0);
  const BoundaryState last = end_state(problem.final_state(), bounds.last, trajectory, intervals);

  PhaseVector state(first.q.begin(), first.q.end());  // q, v, cost so far
  state.insert(state.end(), first.v.begin(), first.v.end());
  state.push_back(0.0);
  Eigen::VectorXd cost_rate(1);
  // Interval by interval: controls jump at the nodes, and a step across a jump has order 1.
  for (Eigen::Index k = 0; k < intervals; ++k) {
    const auto equations = [&](const PhaseVector& x, PhaseVector& derivative, double t) {
      const Eigen::Map<const Eigen::VectorXd> q(x.data(), n);
      const Eigen::Map<const Eigen::VectorXd> v(x.data() + n, n);
      const Eigen::VectorXd u = control_on_interval(trajectory, k, t);
      motion.write_rate(x, u, t, derivative);
      running_cost.evaluate(q, v, u, t, cost_rate);
      derivative.back() = cost_rate[0];
    };
    const double left = trajectory.node_times[k];
    const double right = trajectory.node_times[k + 1];
    if (!integrate(equations, state, left, right, right - left, tolerance)) {
      throw Error(fmt::format("the replay's step size vanished in interval {}", k));
    }
    if (!Eigen::Map<const Eigen::VectorXd>(state.data(), 2 * n + 1).allFinite()) {
      throw Error(fmt::format("the replay left the set where the equations of motion make sense in interval {}", k));
    }
  }
  const Eigen::Map<const Eigen::VectorXd> q(state.data(), n);
  const Eigen::Map<const Eigen::VectorXd> v(state.data() + n, n);
  return {.configuration = (q - last.q).norm(),
          .velocity = (v - last.v).norm(),
          .cost = state.back() + final_cost(problem, {q, v}, trajectory.node_times[intervals])};
}

}  // namespace dmocbench
