#include "methods/transcription/motions/constraint_windows.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/mechanics/formulas_along_motion.hpp"

namespace dmocbench {

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
    throw Error(fmt::format(
        "{}: path_constraints[{}]{} acts on the guess from t = {:.4g} to {:.4g} only, between the stages "
        "at t = {:.4g} and {:.4g}, where no stage meets it; take more intervals, or a grid with a stage there",
        problem_.name(), i, number < names.size() ? " (" + names[number] + ")" : "", times_[first], times_[end - 1],
        *(after - 1), *after));
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
