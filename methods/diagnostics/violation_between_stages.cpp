#include "methods/diagnostics/violation_between_stages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "methods/expression/tape.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/numerics/lagrange_basis.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

namespace {

constexpr Eigen::Index points = 17;             // of an interval, both ends among them
constexpr Eigen::Index intervals_at_once = 32;  // their points stay in the cache
constexpr double rounding = 1e-8;
constexpr double infinite = std::numeric_limits<double>::infinity();

double tau_of(Eigen::Index point) { return static_cast<double>(point) / static_cast<double>(points - 1); }

/// A polynomial basis of the stage times at the points of an interval: a row per point, a column per stage.
Eigen::MatrixXd at_points(const Eigen::VectorXd& c, Eigen::VectorXd (*basis)(const Eigen::VectorXd&, double)) {
  Eigen::MatrixXd rows(points, c.size());
  for (Eigen::Index i = 0; i < points; ++i) rows.row(i) = basis(c, tau_of(i)).transpose();
  return rows;
}

/// The ranges of all components, and the norm of these. A component that is constant to rounding has the norm, and
/// where all of them are, all are 1.
struct Ranges {
  explicit Ranges(const Eigen::MatrixXd& values) : each(values.cols()) {
    if (values.size() == 0) return;
    each = (values.colwise().maxCoeff() - values.colwise().minCoeff()).transpose();
    const double least = rounding * std::max(1.0, values.lpNorm<Eigen::Infinity>());
    if (each.norm() > least) all = each.norm();
    for (double& range : each) range = range > least ? range : all;
  }
  Eigen::VectorXd each;
  double all = 1.0;
};

/// The sides of bounds on q, v and u in one vector, `none` where there is no bound.
Eigen::VectorXd joined(const ProblemBounds& bounds, Eigen::VectorXd Bounds::*side, Eigen::Index n, Eigen::Index m,
                       double none) {
  Eigen::VectorXd all = Eigen::VectorXd::Constant(2 * n + m, none);
  if ((bounds.q.*side).size() == n) all.head(n) = bounds.q.*side;
  if ((bounds.v.*side).size() == n) all.segment(n, n) = bounds.v.*side;
  if ((bounds.u.*side).size() == m) all.tail(m) = bounds.u.*side;
  return all;
}

/// The formulas h at many points.
class PathConstraints {
 public:
  explicit PathConstraints(const TracedProblem& traced)
      : tape_(trace(traced)), workspace_(tape_), values_(points * intervals_at_once, traced.path_constraint_count()) {}

  [[nodiscard]] Eigen::Index count() const { return values_.cols(); }
  /// h, a column per entry, at the first `count` rows of (q, v, u, t).
  [[nodiscard]] Eigen::Ref<const Eigen::MatrixXd> at(const Eigen::MatrixXd& rows, Eigen::Index count) {
    std::vector<Tape::Input> inputs;
    std::vector<double*> outputs;
    for (const auto& column : rows.colwise()) inputs.push_back({column.data(), false});
    for (auto column : values_.colwise()) outputs.push_back(column.data());
    tape_.evaluate(static_cast<std::size_t>(count), inputs, outputs, workspace_);
    return values_.topRows(count);
  }

 private:
  static Tape trace(const TracedProblem& traced) {
    InputCounter inputs;
    const Eigen::Index n = traced.configuration_size();
    const ExpressionVector q = inputs.take(n);
    const ExpressionVector v = inputs.take(n);
    const ExpressionVector u = inputs.take(traced.control_size());
    return Tape(Schedule(traced.at(ControlledState{q, v, u, inputs.take()}).path_constraints));
  }

  Tape tape_;
  Tape::Workspace workspace_;
  Eigen::MatrixXd values_;
};

/// The largest amount by which something is violated, and where.
struct Worst {
  double amount = 0.0;
  Eigen::Index interval = 0;
  double time = 0.0;
  Eigen::RowVectorXd point;  // (q, v, u, t)
};

/// Goes along a motion, some intervals at a time.
class Measurement {
 public:
  Measurement(const Problem& problem, const TracedProblem& traced, const Trajectory& trajectory)
      : problem_(problem),
        traced_(traced),
        trajectory_(trajectory),
        n_(trajectory.q.cols()),
        m_(trajectory.stage_u.cols()),
        integral_(at_points(trajectory.tableau.c, lagrange_integral)),
        basis_(at_points(trajectory.tableau.c, lagrange_basis)),
        rows_(Eigen::MatrixXd::Zero(points * intervals_at_once, 2 * n_ + m_ + 1)),
        scales_(2 * n_ + m_),
        range_of_q_(trajectory.q),
        range_of_v_(trajectory.v),
        outside_(static_cast<std::size_t>(2 * n_ + m_)) {
    const ProblemBounds bounds = problem.bounds();
    lower_ = joined(bounds, &Bounds::lower, n_, m_, -infinite);
    upper_ = joined(bounds, &Bounds::upper, n_, m_, infinite);
    scales_ << range_of_q_.each, range_of_v_.each, Ranges(trajectory.stage_u).each;
    if (traced.path_constraint_count() == 0) return;
    path_.emplace(traced);
    violated_.resize(static_cast<std::size_t>(path_->count()));
  }

  [[nodiscard]] ViolationBetweenStages measured() {
    if (!path_ && !(lower_.array() > -infinite || upper_.array() < infinite).any()) return {};
    for (Eigen::Index k = 0; k < trajectory_.intervals(); k += intervals_at_once) {
      first_ = k;
      count_ = std::min(intervals_at_once, trajectory_.intervals() - k);
      read();
      compare_with_bounds();
      if (path_) evaluate_path_constraints();
    }
    return summary();
  }

 private:
  [[nodiscard]] bool is_bounded(Eigen::Index j) const { return lower_[j] > -infinite || upper_[j] < infinite; }
  /// A component at the points of the present intervals, a column per interval.
  [[nodiscard]] Eigen::Map<Eigen::MatrixXd> block(Eigen::Index j) { return {rows_.col(j).data(), points, count_}; }
  [[nodiscard]] Eigen::Map<const Eigen::MatrixXd> stages(const Eigen::MatrixXd& table, Eigen::Index i) const {
    const Eigen::Index s = trajectory_.stages();
    return {table.col(i).data() + first_ * s, s, count_};
  }

  void read() {
    for (Eigen::Index i = 0; i < n_; ++i) {
      if (path_ || is_bounded(i)) read_configuration(i);
      if (path_ || is_bounded(n_ + i)) block(n_ + i) = basis_.lazyProduct(stages(trajectory_.stage_v, i));
    }
    for (Eigen::Index i = 0; i < m_; ++i) {
      if (path_ || is_bounded(2 * n_ + i)) block(2 * n_ + i) = basis_.lazyProduct(stages(trajectory_.stage_u, i));
    }
    auto times = block(2 * n_ + m_);
    for (Eigen::Index k = 0; k < count_; ++k) {
      for (Eigen::Index i = 0; i < points; ++i) {
        times(i, k) = trajectory_.node_times[first_ + k] + tau_of(i) * trajectory_.step(first_ + k);
      }
    }
  }
  void read_configuration(Eigen::Index i) {
    auto q = block(i);
    q = integral_.lazyProduct(stages(trajectory_.stage_v, i));
    for (Eigen::Index k = 0; k < count_; ++k) {
      q.col(k) = trajectory_.q(first_ + k, i) + trajectory_.step(first_ + k) * q.col(k).array();
    }
    q.bottomRows(1) = trajectory_.q.col(i).segment(first_ + 1, count_).transpose();
  }

  void keep(Worst& worst, double amount, Eigen::Index row) const {
    if (!(amount > worst.amount)) return;
    worst = {amount, first_ + row / points, rows_(row, 2 * n_ + m_), rows_.row(row)};
  }

  void compare_with_bounds() {
    for (Eigen::Index j = 0; j < 2 * n_ + m_; ++j) {
      if (!is_bounded(j)) continue;
      const auto x = rows_.col(j).head(points * count_);
      Eigen::Index lowest = 0;
      Eigen::Index highest = 0;
      const double below = lower_[j] - x.minCoeff(&lowest);
      const double above = x.maxCoeff(&highest) - upper_[j];
      keep(outside_[static_cast<std::size_t>(j)], below, lowest);
      keep(outside_[static_cast<std::size_t>(j)], above, highest);
      if (j >= 2 * n_ && std::max(below, above) > tolerated(scales_[j])) has_excess_ = true;
    }
    if (has_excess_) replay_clipped();
    has_excess_ = false;
  }
  static double tolerated(double scale) { return rounding * std::max(1.0, scale); }

  void evaluate_path_constraints() {
    const Eigen::Ref<const Eigen::MatrixXd> h = path_->at(rows_, points * count_);
    for (Eigen::Index i = 0; i < h.cols(); ++i) {
      Eigen::Index row = 0;
      Worst& worst = violated_[static_cast<std::size_t>(i)];
      // Where a constraint is not a number, the motion has left its domain.
      if (!h.col(i).allFinite()) {
        while (std::isfinite(h(row, i))) ++row;
        keep(worst, infinite, row);
      } else {
        const double least = h.col(i).minCoeff(&row);
        keep(worst, -least, row);
      }
    }
  }

  /// What the present intervals miss where their controls are clipped.
  void replay_clipped() {
    const Eigen::VectorXd lower = lower_.tail(m_);
    const Eigen::VectorXd upper = upper_.tail(m_);
    std::vector<MotionPoint> pairs;  // with the control, and with the clipped one
    std::vector<Eigen::Index> rows;
    for (Eigen::Index row = 0; row < points * count_; ++row) {
      const Eigen::VectorXd u = rows_.row(row).segment(2 * n_, m_).transpose();
      const Eigen::VectorXd clipped = u.cwiseMax(lower).cwiseMin(upper);
      if (((u - clipped).array().abs() <= scales_.tail(m_).array().unaryExpr(&tolerated)).all()) continue;
      const double t = rows_(row, 2 * n_ + m_);
      pairs.push_back(
          {configuration_at(trajectory_, t), velocity_on_interval(trajectory_, first_ + row / points, t), u});
      pairs.push_back(pairs.back());
      pairs.back().u = clipped;
      rows.push_back(row);
    }
    const Eigen::MatrixXd missed = missed_by(pairs, rows);
    for (Eigen::Index k = 0; k < count_; ++k) {
      missed_ +=
          std::max(missed.col(k).head(n_).norm() / range_of_q_.all, missed.col(k).tail(n_).norm() / range_of_v_.all);
    }
  }

  /// (δq, δq̇) of every interval, a column each, by the trapezoidal rule on the points in `rows`.
  [[nodiscard]] Eigen::MatrixXd missed_by(const std::vector<MotionPoint>& pairs,
                                          const std::vector<Eigen::Index>& rows) const {
    Eigen::VectorXd times(static_cast<Eigen::Index>(pairs.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      times.segment(static_cast<Eigen::Index>(2 * i), 2).setConstant(rows_(rows[i], 2 * n_ + m_));
    }
    const Eigen::MatrixXd table = traced_.table(pairs, times);
    Eigen::MatrixXd missed = Eigen::MatrixXd::Zero(2 * n_, count_);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(2 * i);
      const Eigen::Index point = rows[i] % points;
      const Eigen::Index k = rows[i] / points;
      const Eigen::VectorXd force = (table.row(at) - table.row(at + 1)).segment(2 * n_, n_).transpose();
      const Eigen::MatrixXd mass =
          table.row(at).segment(3 * n_ + 1 + traced_.path_constraint_count(), n_ * n_).reshaped(n_, n_);
      const double h = trajectory_.step(first_ + k);
      const bool is_end = point == 0 || point == points - 1;
      const double weight = h / static_cast<double>(points - 1) * (is_end ? 0.5 : 1.0);
      const Eigen::VectorXd impulse = weight * solve_square<double, 1>(mass, force);
      missed.col(k).tail(n_) += impulse;
      missed.col(k).head(n_) += h * (1.0 - tau_of(point)) * impulse;
    }
    return missed;
  }

  [[nodiscard]] std::string name_of_bound(Eigen::Index j) const {
    if (j >= 2 * n_) {
      const Eigen::Index i = j - 2 * n_;
      return fmt::format("bounds().u: u[{}] ({})", i, problem_.control_names()[static_cast<std::size_t>(i)]);
    }
    const Eigen::Index i = j % n_;
    return fmt::format("{}q[{}] ({})", j < n_ ? "bounds().q: " : "bounds().v: the velocity of ", i,
                       problem_.configuration_names()[static_cast<std::size_t>(i)]);
  }
  [[nodiscard]] std::string name_of_path(Eigen::Index i) const {
    const std::vector<std::string> names = problem_.card().path_constraint_names;
    const auto number = static_cast<std::size_t>(i);
    return fmt::format("path_constraints[{}]{}", i, number < names.size() ? " (" + names[number] + ")" : "");
  }

  /// See `violation_between_stages`.
  [[nodiscard]] double path_share(Eigen::Index i, const Worst& worst) {
    if (std::isinf(worst.amount)) return infinite;
    constexpr double delta = largest_violation_of_a_motion;
    const Eigen::Index moved = 2 * n_ + m_;
    Eigen::MatrixXd rows = worst.point.replicate(2 * moved, 1);
    for (Eigen::Index j = 0; j < moved; ++j) {
      rows(2 * j, j) += delta * scales_[j];
      rows(2 * j + 1, j) -= delta * scales_[j];
    }
    const Eigen::VectorXd changes = (path_->at(rows, 2 * moved).col(i).array() + worst.amount).abs();
    double change = 0.0;
    for (Eigen::Index j = 0; j < moved; ++j) change += std::max(changes[2 * j], changes[2 * j + 1]);
    return delta * worst.amount / change;
  }

  [[nodiscard]] ViolationBetweenStages summary() {
    ViolationBetweenStages found;
    const auto take = [&](MotionViolation& kept, double share, const Worst& worst, const std::string& name) {
      if (share > kept.share) kept = {share, worst.amount, name, worst.interval, worst.time};
    };
    for (Eigen::Index j = 0; j < 2 * n_ + m_; ++j) {
      const Worst& worst = outside_[static_cast<std::size_t>(j)];
      found.largest = std::max(found.largest, worst.amount);
      if (worst.amount <= tolerated(scales_[j])) continue;
      take(j < 2 * n_ ? found.state : found.control, worst.amount / scales_[j], worst, name_of_bound(j));
    }
    found.control.share = missed_;
    for (Eigen::Index i = 0; i < std::ssize(violated_); ++i) {
      const Worst& worst = violated_[static_cast<std::size_t>(i)];
      found.largest = std::max(found.largest, worst.amount);
      if (worst.amount > rounding) take(found.state, path_share(i, worst), worst, name_of_path(i));
    }
    return found;
  }

  const Problem& problem_;
  const TracedProblem& traced_;
  const Trajectory& trajectory_;
  Eigen::Index n_;
  Eigen::Index m_;
  Eigen::MatrixXd integral_;
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd rows_;   // (q, v, u, t) at the points of the present intervals
  Eigen::VectorXd lower_;  // of (q, v, u)
  Eigen::VectorXd upper_;
  Eigen::VectorXd scales_;  // of (q, v, u)
  Ranges range_of_q_;
  Ranges range_of_v_;
  std::vector<Worst> outside_;
  std::optional<PathConstraints> path_;
  std::vector<Worst> violated_;  // path constraints
  Eigen::Index first_ = 0;
  Eigen::Index count_ = 0;
  bool has_excess_ = false;
  double missed_ = 0.0;
};

}  // namespace

bool ViolationBetweenStages::is_motion() const {
  return state.share <= largest_violation_of_a_motion && control.share <= largest_miss_of_clipped_controls;
}

std::string ViolationBetweenStages::words(const Trajectory& trajectory, double time_unit) const {
  std::string text;
  const auto add = [&](const MotionViolation& worst, const std::string& size) {
    text += fmt::format(" {} is violated by {:.2g} at t = {:.4g} (interval {}){}.", worst.constraint, worst.size,
                        time_unit * worst.time, worst.interval, size);
  };
  const bool leaves_state = !(state.share <= largest_violation_of_a_motion);
  const bool leaves_controls = !(control.share <= largest_miss_of_clipped_controls);
  if (leaves_state)
    add(state, state.share > 1.0 ? ", more than its scale" : fmt::format(", {:.2g} of its scale", state.share));
  if (leaves_controls)
    add(control, fmt::format("; with clipped controls the motion misses {:.1e} of its range", control.share));
  const Eigen::VectorXd& c = trajectory.tableau.c;
  const bool are_stages_inside = c.minCoeff() > 0.0 || c.maxCoeff() < 1.0;
  const bool helps_one_stage = trajectory.stages() > 1 && (!leaves_state || state.constraint.starts_with("bounds()"));
  return fmt::format("{} Take more intervals{}{}.", text, helps_one_stage ? ", --stages 1" : "",
                     are_stages_inside ? ", or --tableau lobatto" : "");
}

ViolationBetweenStages violation_between_stages(const Problem& problem, const TracedProblem& traced,
                                                const Trajectory& trajectory) {
  return Measurement(problem, traced, trajectory).measured();
}

}  // namespace dmocbench
