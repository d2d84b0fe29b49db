#include "methods/diagnostics/replay_error.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "methods/diagnostics/switch_map.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/numerics/adaptive_integration.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/phase_trajectories.hpp"

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
  for (Eigen::Index i = 0; i < state.y.size(); ++i) {
    if (!bounds.y.is_fixed(i)) state.y[i] = trajectory.y(node, i);
  }
  return state;
}

/// Φ at the end of a motion.
double final_cost(const Problem& problem, const BoundaryState& last, double horizon) {
  PointFunction function(
      problem.configuration_size(), problem.control_size(),
      [&](const ControlledState& x) { return ExpressionVector::Constant(1, problem.final_cost(x.state())); },
      problem.first_order_size());
  Eigen::VectorXd value(1);
  function.evaluate(last.q, last.v, Eigen::VectorXd(), horizon, value, last.y);
  return value[0];
}

/// The continuous system with its running cost, under a trajectory's controls.
class Replay {
 public:
  Replay(const Problem& problem, const Trajectory& trajectory, double tolerance)
      : trajectory_(trajectory),
        tolerance_(tolerance),
        n_(problem.configuration_size()),
        l_(problem.first_order_size()),
        traced_(problem),
        motion_(traced_),
        running_cost_(
            traced_.configuration_size(), traced_.control_size(),
            [&](const ControlledState& x) { return ExpressionVector::Constant(1, traced_.at(x).running_cost); }, l_) {
    if (traced_.constraint_count() > 0) constraints_.emplace(traced_);
  }

  /// q, v, y and a cost so far of 0.
  [[nodiscard]] static std::vector<double> begin_at(const BoundaryState& start) {
    std::vector<double> state(start.q.begin(), start.q.end());
    state.insert(state.end(), start.v.begin(), start.v.end());
    state.insert(state.end(), start.y.begin(), start.y.end());
    state.push_back(0.0);
    return state;
  }

  /// Carries q, v, y and the cost so far through interval k.
  void carry(std::vector<double>& state, Eigen::Index k) {
    const auto equations = [&](const std::vector<double>& x, std::vector<double>& derivative, double t) {
      const Eigen::Map<const Eigen::VectorXd> q(x.data(), n_);
      const Eigen::Map<const Eigen::VectorXd> v(x.data() + n_, n_);
      const Eigen::Map<const Eigen::VectorXd> y(x.data() + 2 * n_, l_);
      const Eigen::VectorXd u = control_on_interval(trajectory_, k, t);
      motion_.write_rate(x, u, t, derivative);
      running_cost_.evaluate(q, v, u, t, cost_rate_, y);
      derivative.back() = cost_rate_[0];
    };
    const double left = trajectory_.node_times[k];
    const double right = trajectory_.node_times[k + 1];
    if (!integrate(equations, state, left, right, right - left, tolerance_)) {
      throw Error(fmt::format("the step size of the replay vanished in interval {}", k));
    }
    if (!Eigen::Map<const Eigen::VectorXd>(state.data(), 2 * n_ + l_ + 1).allFinite()) {
      throw Error(fmt::format("the replay left the domain of the equations of motion in interval {}", k));
    }
    if (constraints_) {
      constraints_->project(Eigen::Map<Eigen::VectorXd>(state.data(), n_),
                            Eigen::Map<Eigen::VectorXd>(state.data() + n_, n_));
    }
  }

 private:
  const Trajectory& trajectory_;
  double tolerance_;
  Eigen::Index n_;
  Eigen::Index l_;
  TracedProblem traced_;
  EquationsOfMotion motion_;
  std::optional<MotionConstraints> constraints_;  // of reduced index, the equations of motion drift away from them
  PointFunction running_cost_;
  Eigen::VectorXd cost_rate_ = Eigen::VectorXd(1);
};

}  // namespace

double ReplayError::norm() const { return std::hypot(configuration, velocity, first_order); }

namespace {

/// Where a motion ends that is integrated from `first` on.
struct ReplayedEnd {
  BoundaryState state;
  double cost;
};

ReplayedEnd replayed(const Problem& problem, const Trajectory& trajectory, const BoundaryState& first,
                     double tolerance) {
  const Eigen::Index n = first.q.size();
  Replay replay(problem, trajectory, tolerance);
  std::vector<double> state = Replay::begin_at(first);
  // Interval by interval: controls jump at the nodes, and a step across a jump has order 1.
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) replay.carry(state, k);
  const Eigen::Map<const Eigen::VectorXd> q(state.data(), n);
  const Eigen::Map<const Eigen::VectorXd> v(state.data() + n, n);
  const Eigen::Map<const Eigen::VectorXd> y(state.data() + 2 * n, first.y.size());
  const BoundaryState last{q, v, y};
  return {last, state.back() + final_cost(problem, last, trajectory.node_times.tail<1>()[0])};
}

ReplayError distance(const BoundaryState& reached, const BoundaryState& last, double cost) {
  return {.configuration = (reached.q - last.q).norm(),
          .velocity = (reached.v - last.v).norm(),
          .first_order = (reached.y - last.y).norm(),
          .cost = cost,
          .q = reached.q - last.q,
          .v = reached.v - last.v};
}

ReplayError replay_error_of(const Problem& problem, const Trajectory& trajectory, double tolerance) {
  const ProblemBounds bounds = problem.bounds();
  const BoundaryState first = end_state(problem.initial_state(), bounds.first, trajectory, 0);
  const BoundaryState last = end_state(problem.final_state(), bounds.last, trajectory, trajectory.intervals());
  const auto [reached, cost] = replayed(problem, trajectory, first, tolerance);
  return distance(reached, last, cost);
}

/// Phase after phase, from the state after the switch to which the phase before has come. The distance of the ends that
/// no phase follows.
ReplayError replay_error_of_phases(const PhasedProblem& problem, const Trajectory& trajectory, double tolerance) {
  const std::vector<PhaseTrajectory> parts = phase_trajectories(problem, trajectory);
  const std::size_t count = parts.size();
  std::vector<BoundaryState> reached(count);
  std::vector<bool> is_followed(count, false);
  for (std::size_t i = 1; i < count; ++i) is_followed[problem.preceding(i)] = true;
  BoundaryState all{.q = Eigen::VectorXd::Zero(problem.configuration_size()),
                    .v = Eigen::VectorXd::Zero(problem.configuration_size()),
                    .y = Eigen::VectorXd::Zero(problem.first_order_size())};
  double total = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Problem& phase = *problem.phases()[i].problem;
    const Trajectory& motion = parts[i].motion;
    const std::size_t before = i > 0 ? problem.preceding(i) : 0;
    const SharedParameters shared(problem, phase);
    const MotionPoint node = motion.node(0);
    const BoundaryState first =
        i == 0 ? end_state(phase.initial_state(), phase.bounds().first, motion, 0)
               : SwitchMap(problem, i - 1, trajectory.unknowns)
                     .after(reached[before], parts[before].motion.node_times.tail<1>()[0], {node.q, node.v, node.y});
    const auto [end, cost] = replayed(phase, motion, first, tolerance);
    reached[i] = end;
    total += cost;
    if (is_followed[i]) continue;
    const BoundaryState last = end_state(phase.final_state(), phase.bounds().last, motion, motion.intervals());
    const PhasedProblem::Part& part = problem.parts()[i];
    all.q.segment(part.q.first, part.q.size) = end.q - last.q;
    all.v.segment(part.q.first, part.q.size) = end.v - last.v;
    all.y.segment(part.y.first, part.y.size) = end.y - last.y;
  }
  const BoundaryState nowhere{.q = 0.0 * all.q, .v = 0.0 * all.v, .y = 0.0 * all.y};
  return distance(all, nowhere, total);
}

}  // namespace

ReplayError replay_error(const Problem& problem, const Trajectory& trajectory, double tolerance) {
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  const PhasedProblem* const phased = problem.phased();
  return phased != nullptr ? replay_error_of_phases(*phased, trajectory, tolerance)
                           : replay_error_of(problem, trajectory, tolerance);
}

double cost_by_intervals(const Problem& problem, const Trajectory& trajectory, double tolerance) {
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  const Eigen::Index intervals = trajectory.intervals();
  Replay replay(problem, trajectory, tolerance);
  const auto at_node = [&](Eigen::Index k) {
    const MotionPoint node = trajectory.node(k);
    return BoundaryState{node.q, node.v, node.y};
  };
  double cost = 0.0;
  for (Eigen::Index k = 0; k < intervals; ++k) {
    std::vector<double> state = Replay::begin_at(at_node(k));
    replay.carry(state, k);
    cost += state.back();
  }
  return cost + final_cost(problem, at_node(intervals), trajectory.node_times[intervals]);
}

}  // namespace dmocbench
