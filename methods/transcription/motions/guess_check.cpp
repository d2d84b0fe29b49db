#include "methods/transcription/motions/guess_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/mechanics/formulas_along_motion.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/mechanics/problem_check.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

namespace {

/// The beginning of a sentence about the guess at time t.
std::string place_of(double t, const Problem& problem, const Grid& grid) {
  const Eigen::VectorXd& nodes = grid.relative_times();
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), t / problem.horizon());
  const auto interval = std::clamp<std::ptrdiff_t>(above - nodes.begin() - 1, 0, nodes.size() - 2);
  return fmt::format("{}: at its guess in interval {} (t = {:g}), ", problem.name(), interval, t);
}

/// The fault of a point of the guess, or empty.
std::string flaw_of(const MotionPoint& point, const TracedProblem& traced) {
  std::string flaw =
      flaw_of_sizes(point, traced.configuration_size(), traced.control_size(), traced.first_order_size());
  if (!flaw.empty()) return flaw;
  const bool is_finite = point.q.allFinite() && point.v.allFinite() && point.u.allFinite() && point.y.allFinite();
  return is_finite ? "" : "the guess itself is not a number";
}

/// The first formula that is not a number in a row of `TracedProblem::table`, with its entry; empty if there is none.
std::string nan_in(const Eigen::VectorXd& values, const TracedProblem& traced) {
  struct Formula {
    const char* name;
    Eigen::Index first;
    Eigen::Index entries;
  };
  const Eigen::Index n = traced.configuration_size();
  for (const Formula& formula : {Formula{"lagrangian by q (L_q)", n, n},
                                 {"lagrangian by q̇ (L_v)", 0, n},
                                 {"force", 2 * n, n},
                                 {"running_cost", 3 * n, 1},
                                 {"path_constraints", 3 * n + 1, traced.path_constraint_count()}}) {
    for (Eigen::Index i = 0; i < formula.entries; ++i) {
      if (std::isfinite(values[formula.first + i])) continue;
      return formula.name + (formula.entries > 1 ? fmt::format("[{}]", i) : "");
    }
  }
  return "";
}

}  // namespace

GuessMagnitudes check_guess(const Problem& problem, const TracedProblem& traced, const Grid& grid, bool needs_mass) {
  constexpr int count = 64;
  const Eigen::Index n = traced.configuration_size();
  const double horizon = problem.horizon();
  std::vector<MotionPoint> points;
  Eigen::VectorXd times(count + 2);
  for (int i = 0; i < count; ++i) {
    times[i] = horizon * (i + 0.5) / count;
    points.push_back(call_formula(problem, "guess", [&] { return problem.guess(times[i]); }));
    const std::string flaw = flaw_of(points.back(), traced);
    if (!flaw.empty()) throw Error(place_of(times[i], problem, grid) + flaw);
  }
  times.tail(2) << 0.0, horizon;
  for (const BoundaryState& end : {problem.initial_state(), problem.final_state()}) {
    points.push_back({end.q, end.v, Eigen::VectorXd::Zero(traced.control_size()), end.y});
  }

  const Eigen::MatrixXd table = traced.table(points, times);
  GuessMagnitudes magnitudes;
  std::optional<MotionConstraints> constraints;
  if (traced.constraint_count() > 0) constraints.emplace(traced);
  FormulaCheck check(problem, FormulaCheck::Derivatives::second);
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    const Eigen::VectorXd values = table.row(i);
    const Eigen::MatrixXd mass = values.segment(3 * n + 1 + traced.path_constraint_count(), n * n).reshaped(n, n);
    const Eigen::VectorXd& q = points[static_cast<std::size_t>(i)].q;
    magnitudes.largest_configuration = std::max(magnitudes.largest_configuration, q.lpNorm<Eigen::Infinity>());
    magnitudes.largest_mass = std::max(magnitudes.largest_mass, mass.lpNorm<Eigen::Infinity>());
    if (i >= count) continue;  // the ends are only measured
    std::string undefined = nan_in(values, traced);
    if (undefined.empty()) undefined = check.undefined_at(points[static_cast<std::size_t>(i)], times[i]);
    if (!undefined.empty()) {
      throw Error(place_of(times[i], problem, grid) + undefined +
                  " is not a number; give a guess that keeps away from the singularity, and bound the coordinates away "
                  "from it");
    }
    if (constraints) {
      constraints->evaluate(q);
      if (!is_invertible(saddle_matrix(mass, constraints->jacobian()))) {
        throw Error(
            place_of(times[i], problem, grid) +
            "the matrix (L_vv, G'; G, 0) is singular: constraints (G = dg/dq or A) are dependent, or L is not regular");
      }
      if (!needs_mass) continue;
    }
    if (!is_invertible(mass)) {
      if (constraints) {
        throw Error(place_of(times[i], problem, grid) +
                    "L_vv is singular; with constraints g(q) = 0 use dmoc with --tableau gauss --stages 1");
      }
      throw Error(place_of(times[i], problem, grid) + "L_vv is singular, so the Lagrangian is not regular");
    }
  }
  return magnitudes;
}

namespace {

/// All stage times in ascending order.
std::vector<double> stage_times(const Tableau& tableau, const Grid& grid, double horizon) {
  std::vector<double> times;
  for (Eigen::Index k = 0; k < grid.relative_widths().size(); ++k) {
    for (const double c : tableau.c) {
      times.push_back(horizon * (grid.relative_times()[k] + c * grid.relative_widths()[k]));
    }
  }
  std::ranges::sort(times);
  return times;
}

/// (q, v, u, y, t) of the guess at evenly spaced times, a row each.
Eigen::MatrixXd sampled_guess(const Problem& problem, Eigen::Index count) {
  Eigen::MatrixXd rows(count,
                       2 * problem.configuration_size() + problem.control_size() + problem.first_order_size() + 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double t = problem.horizon() * static_cast<double>(i) / static_cast<double>(count - 1);
    const MotionPoint point = problem.guess(t);
    rows.row(i) << point.q.transpose(), point.v.transpose(), point.u.transpose(), point.y.transpose(), t;
  }
  return rows;
}

/// By how much values of h, a row each, keep their bounds; negative where one is violated.
Eigen::MatrixXd margins(const Eigen::MatrixXd& h, const Bounds& bounds) {
  const Eigen::MatrixXd above = h.rowwise() - bounds.lower.transpose();
  return above.cwiseMin((bounds.upper.transpose().replicate(h.rows(), 1) - h));
}

/// Looks for windows of one entry of h.
class WindowSearch {
 public:
  WindowSearch(const Problem& problem, const Bounds& bounds, const Eigen::MatrixXd& guess, std::vector<double> stages)
      : problem_(problem),
        bounds_(bounds),
        guess_(guess),
        times_(guess.col(guess.cols() - 1)),
        stages_(std::move(stages)) {}

  /// Throws if a run of negative `values`, of entry `i` along the guess, is a window without a stage.
  void check(const Eigen::VectorXd& values, Eigen::Index i, PathConstraints& path) const {
    const Eigen::Index count = values.size();
    for (Eigen::Index first = 0; first < count; ++first) {
      if (!(values[first] < 0.0)) continue;
      Eigen::Index end = first;
      while (end < count && values[end] < 0.0) ++end;
      if (first > 0 && end < count) check_run(values, first, end, i, path);
      first = end;
    }
  }

 private:
  void check_run(const Eigen::VectorXd& values, Eigen::Index first, Eigen::Index end, Eigen::Index i,
                 PathConstraints& path) const {
    const auto after = std::ranges::lower_bound(stages_, times_[first - 1]);
    if (after == stages_.begin() || after == stages_.end() || *after <= times_[end]) return;
    Eigen::Index worst = 0;
    values.segment(first, end - first).minCoeff(&worst);
    Eigen::MatrixXd held = guess_.row(first + worst).replicate(2, 1);
    held.col(held.cols() - 1) << *(after - 1), *after;
    if (!(margins(path.at(held, 2), bounds_).col(i).array() >= 0.0).all()) return;
    const std::vector<std::string> names = problem_.card().path_constraint_names;
    const auto number = static_cast<std::size_t>(i);
    throw Error(
        "{}: path_constraints[{}]{} is active on the guess only from t = {:.4g} to {:.4g}, between the stages at t = "
        "{:.4g} and {:.4g}, so no stage imposes it; use more intervals, or a grid with a stage there",
        problem_.name(), i, number < names.size() ? " (" + names[number] + ")" : "", times_[first], times_[end - 1],
        *(after - 1), *after);
  }

  const Problem& problem_;
  const Bounds& bounds_;
  const Eigen::MatrixXd& guess_;
  Eigen::VectorXd times_;
  std::vector<double> stages_;
};

}  // namespace

void check_constraint_windows(const Problem& problem, const TracedProblem& traced, const Tableau& tableau,
                              const Grid& grid) {
  if (traced.path_constraint_count() == 0 || problem.bounds().horizon.is_free()) return;
  if (!PathConstraints(traced, 1).reads_time()) return;
  constexpr Eigen::Index per_interval = 8;
  constexpr Eigen::Index least = 4096;
  const Eigen::Index count = std::max(per_interval * static_cast<Eigen::Index>(grid.intervals()), least) + 1;
  PathConstraints path(traced, count);
  const Eigen::MatrixXd guess = sampled_guess(problem, count);
  const Bounds bounds = problem.bounds().of_path(traced.path_constraint_count());
  const Eigen::MatrixXd values = margins(path.at(guess, count), bounds);
  const WindowSearch search(problem, bounds, guess, stage_times(tableau, grid, problem.horizon()));
  for (Eigen::Index i = 0; i < values.cols(); ++i) search.check(values.col(i), i, path);
}

}  // namespace dmocbench
