#include "methods/diagnostics/replay_error.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "methods/diagnostics/driven_motion.hpp"
#include "methods/diagnostics/switch_map.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/mechanics/phased_problem.hpp"
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

/// Carries a motion through interval k under a trajectory's control.
void carry(DrivenMotion& motion, const Trajectory& trajectory, Eigen::Index k) {
  motion.carry([&](double t) { return control_on_interval(trajectory, k, t); }, trajectory.node_times[k],
               trajectory.node_times[k + 1]);
}

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
  DrivenMotion motion(problem, tolerance);
  motion.begin_at(first);
  // Interval by interval: controls jump at the nodes.
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) carry(motion, trajectory, k);
  return {motion.state(), motion.running_cost() + motion.final_cost(trajectory.node_times.tail<1>()[0])};
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
  DrivenMotion motion(problem, tolerance);
  const auto begin_at_node = [&](Eigen::Index k) {
    const MotionPoint node = trajectory.node(k);
    motion.begin_at({node.q, node.v, node.y});
  };
  double cost = 0.0;
  for (Eigen::Index k = 0; k < intervals; ++k) {
    begin_at_node(k);
    carry(motion, trajectory, k);
    cost += motion.running_cost();
  }
  begin_at_node(intervals);
  return cost + motion.final_cost(trajectory.node_times[intervals]);
}

}  // namespace dmocbench
