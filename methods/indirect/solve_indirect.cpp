#include "methods/indirect/solve_indirect.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "methods/error.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/numerics/adaptive_integration.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

namespace {

/// A direct solution as a start: node values joined by straight lines.
class StartingPoint {
 public:
  StartingPoint(const Trajectory& trajectory, double cost_scale) : trajectory_(trajectory), cost_scale_(cost_scale) {}

  ExtremalPoint operator()(double t) const {
    const Eigen::VectorXd& times = trajectory_.node_times;
    const auto above = std::upper_bound(times.begin(), times.end(), t);
    const Eigen::Index k = std::clamp<Eigen::Index>(above - times.begin() - 1, 0, trajectory_.intervals() - 1);
    const double step = times[k + 1] - times[k];
    const double tau = (t - times[k]) / step;
    const auto between = [&](const Eigen::MatrixXd& table) -> Eigen::VectorXd {
      return ((1.0 - tau) * table.row(k) + tau * table.row(k + 1)).transpose();
    };
    const Eigen::VectorXd adjoint_rate = (trajectory_.psi_p.row(k + 1) - trajectory_.psi_p.row(k)).transpose() / step;
    const Eigen::VectorXd u = control_at(trajectory_, t);
    const Eigen::Index n = trajectory_.q.cols();
    ExtremalPoint point{Eigen::VectorXd(4 * n), Eigen::VectorXd(2 * n + u.size())};
    point.y << between(trajectory_.q), between(trajectory_.p), cost_scale_ * between(trajectory_.psi_q),
        cost_scale_ * between(trajectory_.psi_p);
    point.z << between(trajectory_.v), u, cost_scale_ * adjoint_rate;
    return point;
  }

 private:
  const Trajectory& trajectory_;
  double cost_scale_;
};

/// (q, L_v(q, v)) at an end.
Eigen::VectorXd phase_point(LegendreTransform& legendre, const BoundaryState& end, double t) {
  Eigen::VectorXd point(2 * end.q.size());
  point << end.q, legendre.momentum(end.q, end.v, t);
  return point;
}

void require_fit(const Problem& problem, const Trajectory& start) {
  if (!start.has_costates()) {
    throw Error("the indirect method starts from costates: use the solution of a solver with multipliers");
  }
  const Eigen::Index n = problem.configuration_size();
  const double horizon = problem.horizon();
  constexpr double coincidence = 1e-9;
  if (start.q.cols() != n || start.stage_u.cols() != problem.control_size() ||
      std::abs(start.node_times[start.intervals()] - horizon) > coincidence * horizon) {
    throw Error("the start of the indirect method does not match the sizes or the horizon of " + problem.name());
  }
}

}  // namespace

void require_indirect(const Problem& problem) {
  const TracedProblem traced(problem);
  const auto refuse = [&](const std::string& feature) {
    throw Error("the indirect method does not support " + feature + ", which " + problem.name() +
                " has; compare with a finer grid instead");
  };
  const ProblemBounds bounds = problem.bounds();
  if (!bounds.first.all_fixed() || !bounds.last.all_fixed()) refuse("free or bounded ends");
  if (bounds.horizon.is_free()) refuse("a free horizon");
  if (bounds.u.any()) refuse("bounds on the controls");
  if (bounds.q.any() || bounds.v.any()) refuse("bounds on the state");
  if (!bounds.interior.empty()) refuse("bounds between the ends");
  if (traced.path_constraint_count() > 0) refuse("path constraints");
  if (traced.integral_count() > 0) refuse("integral constraints");
  if (traced.first_order_size() > 0) refuse("first-order states");
  if (traced.unknown_count() > 0) refuse("unknown parameters");
  if (traced.holonomic_count() > 0) refuse("constraints g(q) = 0");
  if (traced.constraint_count() > 0) refuse("velocity constraints");
  if (traced.boundary_condition_count() > 0) refuse("boundary conditions");
  const Eigen::Index n = traced.configuration_size();
  const auto size = static_cast<std::size_t>(n);
  const State end{input_vector(0, n), input_vector(size, n), Expression::input(2 * size)};
  if (!problem.final_cost(end).is_zero()) refuse("a final cost");
}

IndirectSolution solve_indirect(const Problem& problem, const Trajectory& start, const IndirectOptions& options) {
  constexpr int lower_stages = 8;
  constexpr int higher_stages = 10;
  require_indirect(problem);
  require_fit(problem, start);
  const PontryaginFunction function(problem);
  LegendreTransform legendre{TracedProblem(problem)};
  const double horizon = problem.horizon();
  const Eigen::VectorXd first = phase_point(legendre, problem.initial_state(), 0.0);
  const Eigen::VectorXd last = phase_point(legendre, problem.final_state(), horizon);

  std::function<ExtremalPoint(double)> begin = StartingPoint(start, function.cost_scale());
  std::optional<IndirectSolution> best;
  for (Eigen::Index intervals = options.fewest_intervals; intervals <= options.most_intervals; intervals *= 2) {
    const auto solved = [&](int stages, Eigen::Index on_intervals) {
      return IndirectSolution(problem, collocate_extremal(function, first, last, horizon, stages, on_intervals, begin),
                              {});
    };
    const IndirectSolution lower = solved(lower_stages, intervals);
    const IndirectSolution higher = solved(higher_stages, intervals * 3 / 2);
    const IndirectAgreement agreement = compare(lower, higher, function.cost_scale());
    begin = [extremal = higher.extremal(), tableau = high_order_gauss_tableau(higher_stages)](double t) {
      return point_on(extremal, tableau, t);
    };
    if (!best || agreement.worst() < best->agreement().worst()) {
      best.emplace(problem, higher.extremal(), agreement);
    }
    if (agreement.worst() <= options.tolerance) break;
  }
  if (!best) throw Error("the indirect method needs at least {} intervals", options.fewest_intervals);
  return *std::move(best);
}

double boundary_value_residual(const Problem& problem, const IndirectSolution& solution) {
  const CollocatedExtremal& extremal = solution.extremal();
  const PontryaginFunction function(problem);
  const Eigen::Index half = function.state_size() / 2;
  const double horizon = problem.horizon();
  if (extremal.nodes.rows() != 2 * half || extremal.algebraic.rows() != function.algebraic_size()) {
    throw Error("the indirect solution does not belong to the problem " + problem.name());
  }
  LegendreTransform legendre{TracedProblem(problem)};
  const Eigen::Index intervals = extremal.intervals();
  Eigen::VectorXd ends = Eigen::VectorXd::Zero(2 * half);
  ends.head(half) = extremal.nodes.col(0).head(half) - phase_point(legendre, problem.initial_state(), 0.0);
  double largest = std::max(relative_difference(ends, extremal.nodes), std::abs(extremal.horizon / horizon - 1.0));
  ends.head(half) = extremal.nodes.col(intervals).head(half) - phase_point(legendre, problem.final_state(), horizon);
  largest = std::max(largest, relative_difference(ends, extremal.nodes));

  const Tableau tableau = high_order_gauss_tableau(extremal.stages);
  const double step = extremal.horizon / static_cast<double>(intervals);
  for (Eigen::Index k = 0; k < intervals; ++k) {
    const auto rates = extremal.rates.middleCols(k * extremal.stages, extremal.stages);
    const Eigen::VectorXd jump = extremal.nodes.col(k) + step * (rates * tableau.b) - extremal.nodes.col(k + 1);
    largest = std::max(largest, relative_difference(jump, extremal.nodes));
    for (Eigen::Index i = 0; i < extremal.stages; ++i) {
      const Eigen::VectorXd y = extremal.nodes.col(k) + step * (rates * tableau.a.row(i).transpose());
      const double t = step * (static_cast<double>(k) + tableau.c[i]);
      Eigen::VectorXd z = extremal.algebraic.col(k * extremal.stages + i);
      largest = std::max(largest, relative_difference(function.evaluate(y, t, z).rate - rates.col(i), extremal.rates));
    }
  }
  return largest;
}

double shooting_defect(const Problem& problem, const IndirectSolution& solution) {
  constexpr double tolerance = 1e-14;  // absolute and relative
  using Extremal = std::vector<double>;
  const PontryaginFunction function(problem);
  const CollocatedExtremal& extremal = solution.extremal();
  const Eigen::VectorXd times = solution.node_times();
  const Eigen::Index size = function.state_size();
  double largest = 0.0;
  for (Eigen::Index k = 0; k < extremal.intervals(); ++k) {
    Eigen::VectorXd z = extremal.algebraic.col(k * extremal.stages);
    const auto equations = [&](const Extremal& y, Extremal& rate, double t) {
      const Eigen::Map<const Eigen::VectorXd> point(y.data(), size);
      Eigen::Map<Eigen::VectorXd>(rate.data(), size) = function.evaluate(point, t, z).rate;
    };
    Extremal y(extremal.nodes.col(k).begin(), extremal.nodes.col(k).end());
    if (!integrate(equations, y, times[k], times[k + 1], times[k + 1] - times[k], tolerance)) {
      throw Error("the step size of the shooting check vanished in interval {}", k);
    }
    const Eigen::VectorXd mismatch = Eigen::Map<const Eigen::VectorXd>(y.data(), size) - extremal.nodes.col(k + 1);
    largest = std::max(largest, relative_difference(mismatch, extremal.nodes));
  }
  return largest;
}

}  // namespace dmocbench
