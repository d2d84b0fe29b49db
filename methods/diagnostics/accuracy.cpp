#include "methods/diagnostics/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "methods/diagnostics/control_saving.hpp"
#include "methods/diagnostics/steps_of_intervals.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/numerics/adaptive_integration.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/points_along.hpp"

namespace dmocbench {

namespace {

/// The size below which a range is rounding.
double rounding_of(const Eigen::MatrixXd& nodes) {
  return smallest_range * std::max(1.0, nodes.lpNorm<Eigen::Infinity>());
}

/// The norm of the ranges of all components over the nodes; 0 where it is no more than rounding.
double range_of(const Eigen::MatrixXd& nodes) {
  const double range = (nodes.colwise().maxCoeff() - nodes.colwise().minCoeff()).norm();
  return range > rounding_of(nodes) ? range : 0.0;
}

/// The end of (q, v, y) of node k under the controls of interval k; empty where that fails.
std::vector<double> carried(EquationsOfMotion& motion, const Trajectory& trajectory, Eigen::Index k, double tolerance) {
  const Eigen::Index n = trajectory.q.cols();
  std::vector<double> state(static_cast<std::size_t>(2 * n + trajectory.y.cols()));
  Eigen::Map<Eigen::VectorXd>(state.data(), n) = trajectory.q.row(k);
  Eigen::Map<Eigen::VectorXd>(state.data() + n, n) = trajectory.v.row(k);
  Eigen::Map<Eigen::VectorXd>(state.data() + 2 * n, trajectory.y.cols()) = Trajectory::row_of(trajectory.y, k);
  const auto equations = [&](const std::vector<double>& x, std::vector<double>& rate, double t) {
    motion.write_rate(x, control_on_interval(trajectory, k, t), t, rate);
  };
  const double left = trajectory.node_times[k];
  const double right = trajectory.node_times[k + 1];
  try {
    if (!integrate(equations, state, left, right, right - left, tolerance)) return {};
  } catch (const Stopped&) {
    throw;
  } catch (const Error&) {  // L_vv is singular where it leads
    return {};
  }
  return state;
}

/// (q, v, y) of the nodes from the first on, a column each.
Eigen::MatrixXd states_from(const Trajectory& trajectory, Eigen::Index first) {
  Eigen::MatrixXd states(trajectory.intervals() + 1 - first, 2 * trajectory.q.cols() + trajectory.y.cols());
  states.leftCols(2 * trajectory.q.cols()) << trajectory.q.bottomRows(states.rows()),
      trajectory.v.bottomRows(states.rows());
  if (trajectory.y.cols() > 0) states.rightCols(trajectory.y.cols()) = trajectory.y.bottomRows(states.rows());
  return states.transpose();
}

/// Where every interval ends, a column each, by a single step; not a number where that is not accurate enough, or not
/// possible.
Eigen::MatrixXd ends_by_steps(const TracedProblem& traced, const Trajectory& trajectory, double tolerance) {
  const auto intervals = static_cast<std::size_t>(trajectory.intervals());
  Eigen::MatrixXd ends =
      Eigen::MatrixXd::Constant(2 * trajectory.q.cols() + trajectory.y.cols(), trajectory.intervals(), std::nan(""));
  if (traced.constraint_count() > 0) return ends;
  std::optional<StepsOfIntervals> steps;
  try {
    steps.emplace(traced);
  } catch (const Error&) {  // L_vv is not definite
    return ends;
  }
  const std::size_t parts = part_count(intervals);
  for_each_part(parts, [&](std::size_t part) {
    const auto last = static_cast<Eigen::Index>(begin_of_part(part + 1, parts, intervals));
    constexpr Eigen::Index at_once = 128;  // their stages stay in the cache
    for (auto k = static_cast<Eigen::Index>(begin_of_part(part, parts, intervals)); k < last; k += at_once) {
      const Eigen::Index count = std::min(at_once, last - k);
      ends.middleCols(k, count) = steps->ends(trajectory, k, count, tolerance);
    }
  });
  return ends;
}

/// Integrates the intervals whose ends are not numbers, in as many steps as they need. Infinite, like those after it in
/// the same part, from the first one on that fails: nothing is worse.
void carry_others(const TracedProblem& traced, const Trajectory& trajectory, double tolerance, Eigen::MatrixXd& ends) {
  std::vector<Eigen::Index> others;
  for (Eigen::Index k = 0; k < ends.cols(); ++k) {
    if (!ends.col(k).allFinite()) others.push_back(k);
  }
  constexpr double shortest = 1e-9;      // 0 would be no limit
  constexpr std::size_t per_part = 256;  // takes about ten milliseconds
  const std::size_t parts = others.empty() ? 0 : part_count(others.size(), per_part);
  std::vector<std::unique_ptr<EquationsOfMotion>> motions;  // one per part, since each has memory of its own
  motions.reserve(parts);
  for (std::size_t part = 0; part < parts; ++part) motions.push_back(std::make_unique<EquationsOfMotion>(traced));
  const double left = std::max(seconds_left(), shortest);
  ends(Eigen::all, others).setConstant(std::numeric_limits<double>::infinity());
  for_each_part(parts, [&](std::size_t part) {
    const StopScope scope(nullptr, left);  // the thread of a part has none
    for (std::size_t i = begin_of_part(part, parts, others.size()); i < begin_of_part(part + 1, parts, others.size());
         ++i) {
      const std::vector<double> state = carried(*motions[part], trajectory, others[i], tolerance);
      const Eigen::Map<const Eigen::VectorXd> end(state.data(), static_cast<Eigen::Index>(state.size()));
      if (state.empty() || !end.allFinite()) break;
      ends.col(others[i]) = end;
    }
  });
}

/// (Δq, Δv, Δy) of every interval, a column each: where it ends, minus its last node.
Eigen::MatrixXd jumps_of(const TracedProblem& traced, const Trajectory& trajectory, double tolerance) {
  Eigen::MatrixXd ends = ends_by_steps(traced, trajectory, tolerance);
  stop_if_requested();
  carry_others(traced, trajectory, tolerance, ends);
  return ends - states_from(trajectory, 1);
}

/// Σ_k ψ_{k+1}·δx_k of the jumps δx_k: by how much they change the least cost, to first order; 0 without costates, or
/// where constraints on q leave a part of them undetermined.
double worth_of(const TracedProblem& traced, const Trajectory& trajectory, const Eigen::MatrixXd& jumps) {
  if (!trajectory.has_costates() || traced.holonomic_count() > 0 || !jumps.allFinite()) return 0.0;
  const Eigen::Index n = trajectory.q.cols();
  const Eigen::Index l = trajectory.y.cols();
  const Eigen::Index intervals = trajectory.intervals();
  Eigen::MatrixXd nodes = Eigen::MatrixXd::Zero(intervals, 2 * n + trajectory.stage_u.cols() + l + 1);
  nodes.leftCols(n) = trajectory.q.bottomRows(intervals);
  nodes.middleCols(n, n) = trajectory.v.bottomRows(intervals);
  if (l > 0) nodes.rightCols(l + 1).leftCols(l) = trajectory.y.bottomRows(intervals);
  nodes.rightCols(1) = trajectory.node_times.tail(intervals);
  Eigen::MatrixXd ends = nodes;
  ends.leftCols(2 * n) += jumps.topRows(2 * n).transpose();
  ends.rightCols(l + 1).leftCols(l) += jumps.bottomRows(l).transpose();
  const Eigen::MatrixXd of_p = traced.table(ends).leftCols(n) - traced.table(nodes).leftCols(n);
  double worth = trajectory.psi_q.bottomRows(intervals).cwiseProduct(jumps.topRows(n).transpose()).sum() +
                 trajectory.psi_p.bottomRows(intervals).cwiseProduct(of_p).sum();
  if (l > 0) worth += trajectory.psi_y.bottomRows(intervals).cwiseProduct(jumps.bottomRows(l).transpose()).sum();
  return worth;
}

/// h C at the share `tau` of every interval, along the elements' polynomials.
Eigen::VectorXd cost_along(const TracedProblem& traced, const Trajectory& trajectory, double tau) {
  Eigen::VectorXd costs(trajectory.intervals());
  constexpr Eigen::Index at_once = 256;  // their formulas stay in the cache
  for (Eigen::Index first = 0; first < costs.size(); first += at_once) {
    const Eigen::Index count = std::min(at_once, costs.size() - first);
    costs.segment(first, count) =
        traced.table(points_along(trajectory, first, count, tau)).col(3 * trajectory.q.cols());
  }
  return costs.cwiseProduct(trajectory.node_times.tail(costs.size()) - trajectory.node_times.head(costs.size()));
}

/// Sets `Accuracy::cost_error`, `Accuracy::cost_miss` and `Accuracy::control_saving`.
void compare_cost(const TracedProblem& traced, const Trajectory& trajectory, double worth, Accuracy& found) {
  constexpr double smallest_cost = 1e-6;  // below it round-off and the tolerance decide
  const Eigen::VectorXd& b = trajectory.tableau.b;
  double of_program = 0.0;
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    of_program += b[i] * cost_along(traced, trajectory, trajectory.tableau.c[i]).sum();
  }
  static const Tableau finer_rule = collocation_tableau("gauss", gauss_nodes(7), 14);
  Eigen::VectorXd of_intervals = Eigen::VectorXd::Zero(trajectory.intervals());
  Eigen::VectorXd squares = of_intervals;
  for (Eigen::Index i = 0; i < finer_rule.stages(); ++i) {
    const Eigen::VectorXd costs = cost_along(traced, trajectory, finer_rule.c[i]);
    of_intervals += finer_rule.b[i] * costs;
    squares += finer_rule.b[i] * costs.cwiseAbs2();
  }
  const double finer = of_intervals.sum();
  const double size = of_intervals.lpNorm<1>();
  const auto share = [&](double of_cost) {
    if (!std::isfinite(finer)) return std::numeric_limits<double>::infinity();
    return std::abs(of_cost) / std::max({size, std::abs(trajectory.cost), smallest_cost});
  };
  found.cost_error = share(finer - of_program);
  found.cost_miss = share(finer - of_program + worth);
  // Where C hardly varies within the intervals, neither does the price of a control.
  constexpr double slow = 0.15;
  const double spread = (squares - of_intervals.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt().sum();
  if (!(spread <= slow * size)) found.control_saving = share(control_saving(traced, trajectory));
}

}  // namespace

bool Accuracy::is_motion() const {
  return relative_jump <= largest_jump_of_a_motion && accumulated_jump <= largest_accumulated_jump_of_a_motion &&
         cost_error <= largest_cost_error_of_a_motion && !(cost_miss > largest_cost_miss_of_a_motion) &&
         !(control_saving > largest_control_saving_of_a_motion);
}

Accuracy accuracy(const Problem& problem, const Trajectory& trajectory, double tolerance) {
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  return accuracy(TracedProblem(problem), trajectory, tolerance);
}

Accuracy accuracy(const TracedProblem& traced, const Trajectory& trajectory, double tolerance) {
  const Eigen::Index n = trajectory.q.cols();
  const double moves = std::max(range_of(trajectory.q), range_of(trajectory.v));
  const auto scale_of = [&](const Eigen::MatrixXd& nodes) {
    if (!(moves > 0.0)) return 1.0;
    const double range = range_of(nodes);
    return std::max(range > 0.0 ? range : moves, rounding_of(nodes) / largest_jump_of_a_motion);
  };
  const Eigen::Index l = trajectory.y.cols();
  const double range_of_q = scale_of(trajectory.q);
  const double range_of_v = scale_of(trajectory.v);
  const double range_of_y = l > 0 ? scale_of(trajectory.y) : 1.0;
  const auto relative_size = [&](const Eigen::VectorXd& of_state) {
    if (!of_state.allFinite()) return std::numeric_limits<double>::infinity();
    return std::max({of_state.head(n).norm() / range_of_q, of_state.segment(n, n).norm() / range_of_v,
                     of_state.tail(l).norm() / range_of_y});
  };
  const Eigen::MatrixXd jumps = jumps_of(traced, trajectory, tolerance);
  Accuracy found;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(jumps.rows());
  found.missed = sum;
  for (Eigen::Index k = 0; k < jumps.cols(); ++k) {
    const double relative = relative_size(jumps.col(k));
    if (relative > found.relative_jump) {
      found.relative_jump = relative;
      found.interval = k;
    }
    found.jump = std::max(found.jump, std::hypot(jumps.col(k).head(n).norm(), jumps.col(k).segment(n, n).norm()));
    sum += jumps.col(k);
    found.missed = found.missed.cwiseMax(sum.cwiseAbs());
    found.accumulated_jump = std::max(found.accumulated_jump, relative_size(sum));
  }
  compare_cost(traced, trajectory, worth_of(traced, trajectory, jumps), found);
  return found;
}

namespace {

/// The distances of one of q and q̇, of which `ranges` are all that hold at one time; some may be empty.
Eigen::VectorXd distances_between(const std::vector<Bounds>& ranges) {
  const Eigen::Index n = ranges.front().lower.size();
  Eigen::VectorXd gaps = Eigen::VectorXd::Zero(n);
  for (const Bounds& a : ranges) {
    for (const Bounds& b : ranges) {
      if (a.lower.size() == n && b.upper.size() == n) gaps = gaps.cwiseMax(a.lower - b.upper);
    }
  }
  return gaps;
}

/// By how much (q, q̇) at a node leaves its bounds.
Eigen::VectorXd outside(const EndBounds& bounds, const Trajectory& motion, Eigen::Index node) {
  const auto excess = [](const Bounds& range, const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return (range.lower - x).cwiseMax(x - range.upper).cwiseMax(0.0);
  };
  Eigen::VectorXd both(2 * motion.q.cols());
  both << excess(bounds.q, motion.q.row(node).transpose()), excess(bounds.v, motion.v.row(node).transpose());
  return both;
}

}  // namespace

Eigen::VectorXd given_distances(const ProblemBounds& bounds) {
  std::vector<Bounds> of_q{bounds.first.q, bounds.last.q};
  std::vector<Bounds> of_v{bounds.first.v, bounds.last.v};
  for (const InteriorBounds& interior : bounds.interior) {
    of_q.push_back(interior.q);
    of_v.push_back(interior.v);
  }
  Eigen::VectorXd both(2 * bounds.first.q.lower.size());
  both << distances_between(of_q), distances_between(of_v);
  return both;
}

bool is_small_distance(double distance, double size) {
  return distance > 0.0 && distance < smallest_distance * std::max(1.0, size);
}

Eigen::VectorXd small_distances(const ProblemBounds& bounds, const Trajectory& motion) {
  constexpr double rounding = 1e-14;  // an end such as cos(π/2)
  Eigen::VectorXd distances = given_distances(bounds);
  const Eigen::Index n = motion.q.cols();
  const double least = rounding * std::max(distances.lpNorm<Eigen::Infinity>(), motion.q.lpNorm<Eigen::Infinity>());
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const auto& values = i < n ? motion.q.col(i) : motion.v.col(i - n);
    const bool is_small = is_small_distance(distances[i], values.lpNorm<Eigen::Infinity>());
    if (distances[i] <= least || !is_small) distances[i] = 0.0;
  }
  return distances;
}

std::string lost_distance(const ProblemBounds& bounds, const Trajectory& motion, const Accuracy& accuracy) {
  constexpr double most_missed = 0.5;
  const Eigen::Index n = motion.q.cols();
  const double horizon = motion.node_times[motion.intervals()] - motion.node_times[0];
  const Eigen::VectorXd distances = small_distances(bounds, motion);
  Eigen::VectorXd missed =
      accuracy.missed.head(2 * n) + outside(bounds.first, motion, 0) + outside(bounds.last, motion, motion.intervals());
  missed.head(n) += horizon * missed.tail(n);
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const auto& values = i < n ? motion.q.col(i) : motion.v.col(i - n);
    const double range = std::max(distances[i], values.maxCoeff() - values.minCoeff());
    if (distances[i] == 0.0 || missed[i] < most_missed * range) continue;
    return fmt::format(
        "Two given states differ by only {:.1e} in an entry, so that a trajectory at rest satisfies the program to the "
        "tolerance. State the problem in units in which this difference is about 1.",
        distances[i]);
  }
  return {};
}

}  // namespace dmocbench
