#include "methods/diagnostics/replay_error.hpp"

#include <cmath>

#include <Eigen/Core>
#include <boost/numeric/odeint.hpp>
#include <boost/numeric/odeint/external/eigen/eigen.hpp>

#include "methods/error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/interpolation.hpp"

namespace dmocbench {

double ReplayError::norm() const { return std::hypot(configuration, velocity); }

ReplayError replay_error(const Problem& problem, const Trajectory& trajectory, double tolerance) {
  namespace odeint = boost::numeric::odeint;
  using PhaseVector = std::vector<double>;
  EquationsOfMotion motion{TracedProblem(problem)};
  const Eigen::Index n = problem.configuration_size();
  const BoundaryState first = problem.initial_state();
  const BoundaryState last = problem.final_state();

  PhaseVector state(first.q.begin(), first.q.end());
  state.insert(state.end(), first.v.begin(), first.v.end());
  auto stepper = odeint::make_controlled<odeint::runge_kutta_fehlberg78<PhaseVector>>(tolerance, tolerance);
  // Interval by interval: controls jump at the nodes, and a step across a jump has order 1.
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const auto equations = [&](const PhaseVector& x, PhaseVector& derivative, double t) {
      const Eigen::Map<const Eigen::VectorXd> q(x.data(), n);
      const Eigen::Map<const Eigen::VectorXd> v(x.data() + n, n);
      Eigen::Map<Eigen::VectorXd>(derivative.data(), n) = v;
      Eigen::Map<Eigen::VectorXd>(derivative.data() + n, n) =
          motion.acceleration(q, v, control_on_interval(trajectory, k, t), t);
    };
    const double left = trajectory.node_times[k];
    const double right = trajectory.node_times[k + 1];
    try {
      odeint::integrate_adaptive(stepper, equations, state, left, right, right - left);
    } catch (const odeint::odeint_error&) {
      throw Error("the replay's step size vanished in interval " + std::to_string(k));
    }
    if (!Eigen::Map<const Eigen::VectorXd>(state.data(), 2 * n).allFinite()) {
      throw Error("the replay left the set where the equations of motion make sense in interval " + std::to_string(k));
    }
  }
  const Eigen::Map<const Eigen::VectorXd> q(state.data(), n);
  const Eigen::Map<const Eigen::VectorXd> v(state.data() + n, n);
  return {.configuration = (q - last.q).norm(), .velocity = (v - last.v).norm()};
}

}  // namespace dmocbench
