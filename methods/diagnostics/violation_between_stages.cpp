#include "methods/diagnostics/violation_between_stages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "methods/mechanics/formulas_along_motion.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

namespace {

constexpr Eigen::Index points = 9;              // of an interval, or of a part of one, both ends among them
constexpr Eigen::Index intervals_at_once = 64;  // their points stay in the cache
constexpr double rounding = 1e-8;
constexpr double narrowest_part = 1e-10;  // of an interval
constexpr double infinite = std::numeric_limits<double>::infinity();
/// Displacements of an entry of (q, v, u, y) to either side: 4δ of its range, half of that, and so on.
constexpr Eigen::Index displacements = 24;
constexpr double largest_displacement = 4.0;
constexpr Eigen::Index displacement_by_delta = 2;

using AtPoints = Eigen::Matrix<double, points, 1>;

double tau_of(Eigen::Index point) { return static_cast<double>(point) / static_cast<double>(points - 1); }

/// The part [from, to] of an interval, whose ends are 0 and 1.
struct Part {
  [[nodiscard]] double tau(Eigen::Index point) const { return from + tau_of(point) * (to - from); }
  double from = 0.0;
  double to = 1.0;
};

/// The Lagrange polynomials of the stage times at the points of a part, a row per point, and their integrals from its
/// beginning, by Simpson's rule, which is exact for up to four stages.
struct PolynomialsAtPoints {
  explicit PolynomialsAtPoints(const Eigen::VectorXd& c, const Part& part = {})
      : value(points, c.size()), integral(Eigen::MatrixXd::Zero(points, c.size())) {
    for (Eigen::Index i = 0; i < points; ++i) value.row(i) = lagrange_basis(c, part.tau(i)).transpose();
    for (Eigen::Index i = 1; i < points; ++i) {
      const double width = part.tau(i) - part.tau(i - 1);
      const Eigen::RowVectorXd middle = lagrange_basis(c, part.tau(i) - 0.5 * width).transpose();
      integral.row(i) = integral.row(i - 1) + width / 6.0 * (value.row(i - 1) + 4.0 * middle + value.row(i));
    }
  }
  Eigen::MatrixXd value;
  Eigen::MatrixXd integral;
};

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

/// The sides of bounds on q, v, u and y in one vector, `none` where there is no bound.
Eigen::VectorXd joined(const ProblemBounds& bounds, Eigen::VectorXd Bounds::*side, Eigen::Index n, Eigen::Index m,
                       Eigen::Index l, double none) {
  Eigen::VectorXd all = Eigen::VectorXd::Constant(2 * n + m + l, none);
  if ((bounds.q.*side).size() == n) all.head(n) = bounds.q.*side;
  if ((bounds.v.*side).size() == n) all.segment(n, n) = bounds.v.*side;
  if ((bounds.u.*side).size() == m) all.segment(2 * n, m) = bounds.u.*side;
  if ((bounds.y.*side).size() == l) all.tail(l) = bounds.y.*side;
  return all;
}

/// The largest amount by which something is violated, and where.
struct Worst {
  double amount = 0.0;
  Eigen::Index interval = 0;
  double time = 0.0;
  Eigen::RowVectorXd point;  // (q, v, u, y, t)
};

/// Evaluates a motion at points between the stages, for some intervals at a time, and keeps the worst violation of each
/// bound and path constraint.
class Measurement {
 public:
  Measurement(const Problem& problem, const ProblemBounds& bounds, const TracedProblem& traced,
              const Trajectory& trajectory)
      : problem_(problem),
        traced_(traced),
        trajectory_(trajectory),
        n_(trajectory.q.cols()),
        m_(trajectory.stage_u.cols()),
        l_(trajectory.y.cols()),
        basis_(trajectory.tableau.c),
        rows_(Eigen::MatrixXd::Zero(points * intervals_at_once, 2 * n_ + m_ + l_ + 1)),
        scales_(2 * n_ + m_ + l_),
        range_of_q_(trajectory.q),
        range_of_v_(trajectory.v),
        outside_(static_cast<std::size_t>(2 * n_ + m_ + l_)) {
    lower_ = joined(bounds, &Bounds::lower, n_, m_, l_, -infinite);
    upper_ = joined(bounds, &Bounds::upper, n_, m_, l_, infinite);
    scales_ << range_of_q_.each, range_of_v_.each, Ranges(trajectory.stage_u).each, Ranges(trajectory.y).each;
    if (traced.path_constraint_count() == 0) return;
    path_bounds_ = bounds.of_path(traced.path_constraint_count());
    path_.emplace(traced, std::max(points * intervals_at_once, 2 * displacements * scales_.size() + 1));
    violated_.resize(static_cast<std::size_t>(path_->count()));
  }

  [[nodiscard]] ViolationBetweenStages measured() {
    for (Eigen::Index k = 0; k < trajectory_.intervals(); k += intervals_at_once) {
      first_ = k;
      count_ = std::min(intervals_at_once, trajectory_.intervals() - k);
      for (Eigen::Index j = 0; j < scales_.size(); ++j) {
        if (path_ || is_bounded(j)) read(j);
      }
      read_times();
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

  void read(Eigen::Index j) {
    auto values = block(j);
    if (is_control(j)) values = basis_.value.lazyProduct(stages(trajectory_.stage_u, j - 2 * n_));
    if (j >= n_ && j < 2 * n_) values = basis_.value.lazyProduct(stages(trajectory_.stage_v, j - n_));
    if (j < n_) integrate(trajectory_.q.col(j), stages(trajectory_.stage_v, j), values);
    if (j < 2 * n_ + m_) return;
    const Eigen::Index i = j - 2 * n_ - m_;
    integrate(trajectory_.y.col(i), stages(trajectory_.stage_y_rates, i), values);
  }
  [[nodiscard]] bool is_control(Eigen::Index j) const { return j >= 2 * n_ && j < 2 * n_ + m_; }
  /// From its nodes and the rates at the stages.
  void integrate(const Eigen::Ref<const Eigen::VectorXd>& nodes, const Eigen::Map<const Eigen::MatrixXd>& rates,
                 Eigen::Map<Eigen::MatrixXd>& values) const {
    values = basis_.integral.lazyProduct(rates);
    for (Eigen::Index k = 0; k < count_; ++k) {
      values.col(k) = nodes[first_ + k] + trajectory_.step(first_ + k) * values.col(k).array();
    }
    values.bottomRows(1) = nodes.segment(first_ + 1, count_).transpose();
  }
  void read_times() {
    auto times = block(2 * n_ + m_ + l_);
    for (Eigen::Index k = 0; k < count_; ++k) {
      for (Eigen::Index i = 0; i < points; ++i) {
        times(i, k) = trajectory_.node_times[first_ + k] + tau_of(i) * trajectory_.step(first_ + k);
      }
    }
  }

  void keep(Worst& worst, double amount, Eigen::Index row) const {
    if (!(amount > worst.amount)) return;
    worst = {amount, first_ + row / points, rows_(row, 2 * n_ + m_ + l_), rows_.row(row)};
  }

  void compare_with_bounds() {
    for (Eigen::Index j = 0; j < scales_.size(); ++j) {
      if (!is_bounded(j)) continue;
      const auto x = rows_.col(j).head(points * count_);
      Eigen::Index lowest = 0;
      Eigen::Index highest = 0;
      const double below = lower_[j] - x.minCoeff(&lowest);
      const double above = x.maxCoeff(&highest) - upper_[j];
      keep(outside_[static_cast<std::size_t>(j)], below, lowest);
      keep(outside_[static_cast<std::size_t>(j)], above, highest);
      if (is_control(j) && std::max(below, above) > tolerated(scales_[j])) has_excess_ = true;
    }
    if (has_excess_) replay_clipped();
    has_excess_ = false;
  }
  static double tolerated(double scale) { return rounding * std::max(1.0, scale); }

  void evaluate_path_constraints() {
    const Eigen::MatrixXd h = path_->at(rows_, points * count_);
    for (Eigen::Index k = 0; k < count_; ++k) {
      for (Eigen::Index i = 0; i < h.cols(); ++i) {
        search(i, first_ + k, Part{}, rows_.middleRows(k * points, points), h.col(i).segment<points>(k * points));
      }
    }
  }

  /// Keeps the worst of h_i at the points of a part of interval k, and searches on about each of its least values that
  /// may hide a worse one.
  void search(Eigen::Index i, Eigen::Index k, const Part& part, const Eigen::Ref<const Eigen::MatrixXd>& rows,
              const AtPoints& h) {
    Worst& worst = violated_[static_cast<std::size_t>(i)];
    const auto keep_worse = [&](double amount, Eigen::Index row) {
      if (amount > worst.amount) worst = {amount, k, rows(row, 2 * n_ + m_ + l_), rows.row(row)};
    };
    // Where a constraint is not a number, the motion has left its domain.
    if (!h.allFinite()) {
      Eigen::Index row = 0;
      while (std::isfinite(h[row])) ++row;
      return keep_worse(infinite, row);
    }
    for (const AtPoints& inside :
         {AtPoints(h.array() - path_bounds_.lower[i]), AtPoints(path_bounds_.upper[i] - h.array())}) {
      Eigen::Index least = 0;
      const double lowest = inside.minCoeff(&least);
      keep_worse(-lowest, least);
      for (Eigen::Index point = 0; point < points; ++point) {
        if (!may_hide_worse(inside, point, worst.amount)) continue;
        const Part next{part.tau(std::max<Eigen::Index>(point - 1, 0)), part.tau(std::min(point + 1, points - 1))};
        if (next.to - next.from < narrowest_part) continue;
        const Eigen::MatrixXd rows_of_next = rows_of(k, next);
        search(i, k, next, rows_of_next, path_->at(rows_of_next, points).col(i));
      }
    }
  }

  /// Whether a distance to a bound has a minimum about a point, and its differences there would carry it further
  /// beyond the bound than `amount`. Half of `most_descent` would do for what is convex.
  [[nodiscard]] static bool may_hide_worse(const AtPoints& inside, Eigen::Index point, double amount) {
    const double here = inside[point];
    const double before = point > 0 ? inside[point - 1] : infinite;
    const double after = point + 1 < points ? inside[point + 1] : infinite;
    if (!(here < before && here <= after)) return false;
    constexpr double most_descent = 4.0;
    constexpr double worth = 1.01;
    const double highest = std::max(point > 0 ? before : here, point + 1 < points ? after : here);
    return here - most_descent * (highest - here) < -worth * amount - rounding;
  }

  /// (q, v, u, y, t) at the points of a part of interval k.
  [[nodiscard]] Eigen::MatrixXd rows_of(Eigen::Index k, const Part& part) const {
    const Eigen::Index s = trajectory_.stages();
    const PolynomialsAtPoints basis(trajectory_.tableau.c, part);
    const Eigen::RowVectorXd until = integral_until(part.from);
    const double step = trajectory_.step(k);
    const auto integrated = [&](const Eigen::MatrixXd& nodes, const Eigen::MatrixXd& rates) -> Eigen::MatrixXd {
      const auto of_interval = rates.middleRows(k * s, s);
      return ((basis.integral.rowwise() + until) * of_interval * step).rowwise() + nodes.row(k);
    };
    Eigen::MatrixXd rows(points, 2 * n_ + m_ + l_ + 1);
    rows.leftCols(n_) = integrated(trajectory_.q, trajectory_.stage_v);
    rows.middleCols(n_, n_) = basis.value * trajectory_.stage_v.middleRows(k * s, s);
    rows.middleCols(2 * n_, m_) = basis.value * trajectory_.stage_u.middleRows(k * s, s);
    if (l_ > 0) rows.middleCols(2 * n_ + m_, l_) = integrated(trajectory_.y, trajectory_.stage_y_rates);
    for (Eigen::Index i = 0; i < points; ++i) {
      rows(i, 2 * n_ + m_ + l_) = trajectory_.node_times[k] + part.tau(i) * step;
    }
    return rows;
  }
  /// The integrals of the Lagrange polynomials from the beginning of an interval.
  [[nodiscard]] Eigen::RowVectorXd integral_until(double tau) const {
    return PolynomialsAtPoints(trajectory_.tableau.c, {0.0, tau}).integral.bottomRows(1);
  }

  /// Whether a control is beyond its bounds at a point.
  [[nodiscard]] bool is_clipped(Eigen::Index row) const {
    for (Eigen::Index j = 2 * n_; j < 2 * n_ + m_; ++j) {
      if (std::max(lower_[j] - rows_(row, j), rows_(row, j) - upper_[j]) > tolerated(scales_[j])) return true;
    }
    return false;
  }

  /// The misses of the present intervals where their controls are clipped.
  void replay_clipped() {
    for (Eigen::Index j = 0; j < scales_.size(); ++j) read(j);
    std::vector<Eigen::Index> rows;
    for (Eigen::Index row = 0; row < points * count_; ++row) {
      if (is_clipped(row)) rows.push_back(row);
    }
    const Eigen::MatrixXd missed = missed_at(rows);
    for (Eigen::Index k = 0; k < count_; ++k) {
      missed_ +=
          std::max(missed.col(k).head(n_).norm() / range_of_q_.all, missed.col(k).tail(n_).norm() / range_of_v_.all);
    }
  }

  /// (δq, δq̇) of every interval, a column each, by the trapezoidal rule on these points.
  [[nodiscard]] Eigen::MatrixXd missed_at(const std::vector<Eigen::Index>& rows) {
    const auto count = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd pairs(2 * count, rows_.cols());  // with the controls, and with the clipped ones
    pairs << rows_(rows, Eigen::all), rows_(rows, Eigen::all);
    for (Eigen::Index j = 2 * n_; j < 2 * n_ + m_; ++j) {
      pairs.col(j).tail(count) = pairs.col(j).head(count).cwiseMax(lower_[j]).cwiseMin(upper_[j]);
    }
    const Eigen::MatrixXd table = traced_.table(pairs);
    Eigen::MatrixXd missed = Eigen::MatrixXd::Zero(2 * n_, count_);
    Eigen::MatrixXd cut = Eigen::MatrixXd::Zero(m_, count_);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Index row = rows[static_cast<std::size_t>(i)];
      const Eigen::Index point = row % points;
      const Eigen::Index k = row / points;
      const Eigen::VectorXd force = (table.row(i) - table.row(count + i)).segment(2 * n_, n_).transpose();
      const Eigen::MatrixXd mass =
          table.row(i).segment(3 * n_ + 1 + traced_.path_constraint_count(), n_ * n_).reshaped(n_, n_);
      const double h = trajectory_.step(first_ + k);
      const bool is_end = point == 0 || point == points - 1;
      const double weight = (is_end ? 0.5 : 1.0) / static_cast<double>(points - 1);
      cut.col(k) += weight * ((pairs.row(i) - pairs.row(count + i)).segment(2 * n_, m_).transpose().array().abs() /
                              scales_.segment(2 * n_, m_).array())
                                 .matrix();
      const Eigen::VectorXd impulse = h * weight * solve_square<double, 1>(mass, force);
      missed.col(k).tail(n_) += impulse;
      missed.col(k).head(n_) += h * (1.0 - tau_of(point)) * impulse;
    }
    clipped_share_ = std::max(clipped_share_, cut.maxCoeff());
    return missed;
  }

  [[nodiscard]] std::string name_of_bound(Eigen::Index j) const {
    if (j >= 2 * n_ + m_) {
      const Eigen::Index i = j - 2 * n_ - m_;
      return fmt::format("{}: y[{}] ({})", member_name("bounds().y"), i,
                         problem_.first_order_names()[static_cast<std::size_t>(i)]);
    }
    if (j >= 2 * n_) {
      const Eigen::Index i = j - 2 * n_;
      return fmt::format("{}: u[{}] ({})", member_name("bounds().u"), i,
                         problem_.control_names()[static_cast<std::size_t>(i)]);
    }
    const Eigen::Index i = j % n_;
    return fmt::format("{}q[{}] ({})", member_name(j < n_ ? "bounds().q: " : "bounds().v: the velocity of "), i,
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
    const Eigen::Index moved = scales_.size();
    const Eigen::Index last = 2 * displacements * moved;
    Eigen::MatrixXd rows = worst.point.replicate(last + 1, 1);  // the last one stays
    for (Eigen::Index j = 0; j < moved; ++j) {
      double size = largest_displacement * delta * scales_[j];
      for (Eigen::Index row = 2 * displacements * j; row < 2 * displacements * (j + 1); row += 2, size *= 0.5) {
        rows(row, j) += size;
        rows(row + 1, j) -= size;
      }
    }
    const Eigen::VectorXd h = path_->at(rows, last + 1).col(i);
    const double sign = h[last] > path_bounds_.upper[i] ? -1.0 : 1.0;
    const Eigen::VectorXd rises = sign * (h.array() - h[last]);
    double change = 0.0;
    double descent = 0.0;
    for (Eigen::Index j = 0; j < moved; ++j) {
      const auto of_entry = rises.segment(2 * displacements * j, 2 * displacements);
      change += of_entry.segment<2>(2 * displacement_by_delta).cwiseAbs().maxCoeff();
      descent += std::max(0.0, -of_entry.minCoeff<Eigen::PropagateNumbers>());
    }
    const double share = delta * worst.amount / change;
    const double of_depth = worst.amount / (worst.amount + descent);
    return share <= delta && of_depth > largest_share_of_depth ? of_depth : share;
  }

  [[nodiscard]] ViolationBetweenStages summary() {
    ViolationBetweenStages found;
    const auto take = [&](MotionViolation& kept, double share, const Worst& worst, const std::string& name,
                          bool is_bound) {
      if (share > kept.share) kept = {share, worst.amount, name, is_bound, worst.interval, worst.time};
    };
    for (Eigen::Index j = 0; j < scales_.size(); ++j) {
      const Worst& worst = outside_[static_cast<std::size_t>(j)];
      found.largest = std::max(found.largest, worst.amount);
      if (worst.amount <= tolerated(scales_[j])) continue;
      take(is_control(j) ? found.control : found.state, worst.amount / scales_[j], worst, name_of_bound(j), true);
    }
    found.control.share = clipped_share_;
    found.missed = missed_;
    for (Eigen::Index i = 0; i < std::ssize(violated_); ++i) {
      const Worst& worst = violated_[static_cast<std::size_t>(i)];
      found.largest = std::max(found.largest, worst.amount);
      if (worst.amount > rounding) take(found.state, path_share(i, worst), worst, name_of_path(i), false);
    }
    return found;
  }

  const Problem& problem_;
  const TracedProblem& traced_;
  const Trajectory& trajectory_;
  Eigen::Index n_;
  Eigen::Index m_;
  Eigen::Index l_;
  PolynomialsAtPoints basis_;
  Eigen::MatrixXd rows_;   // (q, v, u, y, t) at the points of the present intervals
  Eigen::VectorXd lower_;  // of (q, v, u, y)
  Eigen::VectorXd upper_;
  Eigen::VectorXd scales_;  // of (q, v, u, y)
  Ranges range_of_q_;
  Ranges range_of_v_;
  std::vector<Worst> outside_;
  std::optional<PathConstraints> path_;
  Bounds path_bounds_;
  std::vector<Worst> violated_;  // path constraints
  Eigen::Index first_ = 0;
  Eigen::Index count_ = 0;
  bool has_excess_ = false;
  double clipped_share_ = 0.0;
  double missed_ = 0.0;
};

}  // namespace

bool ViolationBetweenStages::keeps_state() const { return state.share <= largest_violation_of_a_motion; }

bool ViolationBetweenStages::keeps_controls() const {
  return control.share <= largest_violation_of_a_motion || missed <= smallest_miss;
}

std::string ViolationBetweenStages::words(const Trajectory& trajectory, double time_unit) const {
  std::string text;
  const auto add = [&](const MotionViolation& worst, const std::string& size) {
    text += fmt::format(" {} is violated by {:.2g} at t = {:.4g} (interval {}){}.", worst.constraint, worst.size,
                        time_unit * worst.time, worst.interval, size);
  };
  if (!keeps_state())
    add(state, state.share > 1.0 ? ", more than its scale" : fmt::format(", {:.2g} of its scale", state.share));
  if (!keeps_controls())
    add(control, fmt::format("; with clipped controls the motion misses {:.1e} of its range", missed));
  const Eigen::VectorXd& c = trajectory.tableau.c;
  const bool are_stages_inside = c.minCoeff() > 0.0 || c.maxCoeff() < 1.0;
  const bool helps_one_stage = trajectory.stages() > 1 && (keeps_state() || state.is_bound);
  return fmt::format("{} Take more intervals{}{}.", text, helps_one_stage ? ", --stages 1" : "",
                     !are_stages_inside         ? ""
                     : trajectory.stages() == 1 ? ", or --tableau lobatto --stages 2"
                                                : ", or --tableau lobatto");
}

ViolationBetweenStages violation_between_stages(const Problem& problem, const TracedProblem& traced,
                                                const Trajectory& trajectory) {
  const ProblemBounds bounds = problem.bounds();
  const bool is_bounded = bounds.q.any() || bounds.v.any() || bounds.u.any() || bounds.y.any();
  // With one stage q̇ and u are constant in an interval, and q is linear.
  const bool may_leave_bounds = is_bounded && trajectory.stages() > 1;
  if (!may_leave_bounds && traced.path_constraint_count() == 0) return {};
  return Measurement(problem, bounds, traced, trajectory).measured();
}

}  // namespace dmocbench
