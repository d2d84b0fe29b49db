#include "methods/diagnostics/violation_between_stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/expression/enclosure.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/formulas_along_motion.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/points_along.hpp"

namespace dmocbench {

namespace {

constexpr Eigen::Index points = 9;              // of an interval, or of a part of one, both ends among them
constexpr Eigen::Index intervals_at_once = 64;  // their points stay in the cache
constexpr double rounding = 1e-8;
constexpr double rounding_of_depth = 1e-12;  // of the constraint's values about the obstacle
constexpr double finest = 1e-9;              // difference of violations that is searched for
constexpr double narrowest_part = 1e-10;     // of an interval
constexpr double infinite = std::numeric_limits<double>::infinity();
/// Displacements of an entry of (q, v, u, y) to either side: 4δ of its range, half of that, and so on.
constexpr Eigen::Index displacements = 24;
constexpr double largest_displacement = 4.0;
constexpr Eigen::Index displacement_by_delta = 2;

double tau_of(Eigen::Index point) { return static_cast<double>(point) / static_cast<double>(points - 1); }

/// The Lagrange polynomials of some times at the points, a row per point, and their integrals from the beginning, by
/// Simpson's rule, which is exact for up to four times.
struct PolynomialsAtPoints {
  explicit PolynomialsAtPoints(const Eigen::VectorXd& c)
      : value(points, c.size()), integral(Eigen::MatrixXd::Zero(points, c.size())) {
    for (Eigen::Index i = 0; i < points; ++i) value.row(i) = lagrange_basis(c, tau_of(i)).transpose();
    constexpr double width = 1.0 / static_cast<double>(points - 1);
    for (Eigen::Index i = 1; i < points; ++i) {
      const Eigen::RowVectorXd middle = lagrange_basis(c, tau_of(i) - 0.5 * width).transpose();
      integral.row(i) = integral.row(i - 1) + width / 6.0 * (value.row(i - 1) + 4.0 * middle + value.row(i));
    }
  }
  Eigen::MatrixXd value;
  Eigen::MatrixXd integral;
};

/// The coefficients of the Lagrange polynomials of some times, a column each, from the constant one.
Eigen::MatrixXd lagrange_coefficients(const Eigen::VectorXd& c) {
  Eigen::MatrixXd powers(c.size(), c.size());
  for (Eigen::Index j = 0; j < c.size(); ++j) powers.col(j) = c.array().pow(static_cast<double>(j));
  return powers.inverse();
}

/// (q, v, u, y, t) in one interval as polynomials of τ in [0, 1], a column each, from the constant coefficient.
using Polynomials = Eigen::MatrixXd;

/// The part of an interval about a time τ.
struct Part {
  double middle = 0.5;
  double half = 0.5;
  [[nodiscard]] double from() const { return middle - half; }
  [[nodiscard]] double to() const { return middle + half; }
};

/// The coefficients about another time.
Polynomials moved(Polynomials polynomials, double tau) {
  for (Eigen::Index i = 1; i < polynomials.rows(); ++i) {
    for (Eigen::Index j = polynomials.rows() - 1; j >= i; --j) polynomials.row(j - 1) += tau * polynomials.row(j);
  }
  return polynomials;
}

/// The ranges of polynomials, given about the middle of a part, and of their rates.
std::vector<EnclosedRate> ranges_on(const Polynomials& about_middle, const Part& part) {
  std::vector<EnclosedRate> ranges;
  ranges.reserve(static_cast<std::size_t>(about_middle.cols()));
  for (const auto& x : about_middle.colwise()) {
    double swing = 0.0;
    double swing_of_rate = 0.0;
    double power = 1.0;
    for (Eigen::Index i = 1; i < x.size(); ++i) {
      if (i > 1) swing_of_rate += static_cast<double>(i) * std::abs(x[i]) * power;
      power *= part.half;
      swing += std::abs(x[i]) * power;
    }
    const double rate = x.size() > 1 ? x[1] : 0.0;
    ranges.emplace_back(Enclosure{x[0] - swing, x[0] + swing}, Enclosure{rate - swing_of_rate, rate + swing_of_rate});
  }
  return ranges;
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

/// The prices of bounds on (q, v, u, y, h) in every interval, a row each, 0 for u: the sum of those at both nodes, or
/// the integral of those at the stages.
Eigen::MatrixXd prices_of_intervals(const Trajectory& trajectory, Eigen::Index path_constraints) {
  const Eigen::Index n = trajectory.q.cols();
  const Eigen::Index count = trajectory.intervals();
  const Eigen::Index first_of_y = 2 * n + trajectory.stage_u.cols();
  const Eigen::Index first_of_path = first_of_y + trajectory.y.cols();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(count, first_of_path + path_constraints);
  const auto of_nodes = [&](const Eigen::MatrixXd& table, Eigen::Index first) {
    if (table.cols() > 0) all.middleCols(first, table.cols()) = table.topRows(count) + table.bottomRows(count);
  };
  const auto of_stages = [&](const Eigen::MatrixXd& table, Eigen::Index first) {
    if (table.cols() == 0) return;
    all.middleCols(first, table.cols()) =
        (trajectory.node_times.tail(count) - trajectory.node_times.head(count)).asDiagonal() *
        weighted_stages(table, trajectory.tableau.b, 0, count);
  };
  of_nodes(trajectory.prices.q, 0);
  of_stages(trajectory.prices.stage_v, n);
  of_nodes(trajectory.prices.y, first_of_y);
  of_stages(trajectory.prices.path, first_of_path);
  constexpr double smallest = 1e-6;  // of the largest in its column; others belong to bounds that are not active
  for (auto of_bound : all.colwise()) {
    of_bound = (of_bound.array().abs() > smallest * of_bound.lpNorm<Eigen::Infinity>()).select(of_bound, 0.0);
  }
  return all;
}

/// (q, v, y) of a node and its rate under the controls of interval k, a column each.
Eigen::MatrixXd state_and_rate(EquationsOfMotion& motion, const Trajectory& trajectory, Eigen::Index node,
                               Eigen::Index k) {
  const auto [q, v, none, y] = trajectory.node(node);
  const double t = trajectory.node_times[node];
  Eigen::MatrixXd both(q.size() + v.size() + y.size(), 2);
  both.col(0) << q, v, y;
  const std::vector<double> state(both.col(0).begin(), both.col(0).end());
  std::vector<double> rate(state.size());
  motion.write_rate(state, control_on_interval(trajectory, k, t), t, rate);
  both.col(1) = Eigen::Map<const Eigen::VectorXd>(rate.data(), both.rows());
  return both;
}

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
        times_of_velocity_(times_of_velocity()),
        basis_of_velocity_(times_of_velocity_),
        coefficients_(lagrange_coefficients(trajectory.tableau.c)),
        coefficients_of_velocity_(lagrange_coefficients(times_of_velocity_)),
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
    path_ = std::make_unique<PathConstraints>(
        traced, std::max(points * intervals_at_once, 2 * displacements * scales_.size() + 1));
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
      if (path_ && k == 0) set_finest();
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
    if (j >= n_ && j < 2 * n_) read_velocity(j - n_, values);
    if (j < n_) integrate(trajectory_.q.col(j), stages(trajectory_.stage_v, j), values);
    if (j < 2 * n_ + m_) return;
    const Eigen::Index i = j - 2 * n_ - m_;
    integrate(trajectory_.y.col(i), stages(trajectory_.stage_y_rates, i), values);
  }
  void read_velocity(Eigen::Index i, Eigen::Map<Eigen::MatrixXd>& values) const {
    if (trajectory_.stages() > 1) {
      values = basis_.value.lazyProduct(stages(trajectory_.stage_v, i));
      return;
    }
    for (Eigen::Index k = 0; k < count_; ++k) {
      values.col(k) = basis_of_velocity_.value * velocities(first_ + k).col(i);
    }
  }
  /// When the velocity is read: at the stages. One stage has the mean velocity of its interval, so there it is read at
  /// both nodes too, as files show it.
  [[nodiscard]] Eigen::VectorXd times_of_velocity() const {
    const Eigen::VectorXd& c = trajectory_.tableau.c;
    return trajectory_.stages() == 1 ? Eigen::VectorXd(Eigen::Vector3d(0.0, c[0], 1.0)) : c;
  }
  /// The velocities of interval k at these times.
  [[nodiscard]] Eigen::MatrixXd velocities(Eigen::Index k) const {
    const Eigen::Index s = trajectory_.stages();
    if (s > 1) return trajectory_.stage_v.middleRows(k * s, s);
    Eigen::MatrixXd three(3, n_);
    three << trajectory_.v.row(k), trajectory_.stage_v.row(k), trajectory_.v.row(k + 1);
    return three;
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

  /// `finest`, or less where h_i changes by less than 1 when each entry moves by its range.
  void set_finest() {
    const Eigen::Index last = 2 * scales_.size();
    Eigen::MatrixXd rows = rows_.row(points / 2).replicate(last + 1, 1);
    for (Eigen::Index j = 0; j < scales_.size(); ++j) {
      rows(2 * j, j) += scales_[j];
      rows(2 * j + 1, j) -= scales_[j];
    }
    const Eigen::MatrixXd h = path_->at(rows, last + 1);
    finest_ = (h.rowwise() - h.row(last)).cwiseAbs().colwise().maxCoeff().transpose();
    for (double& change : finest_) change = finest * (change > 0.0 && change < 1.0 ? change : 1.0);
  }

  void evaluate_path_constraints() {
    const Eigen::MatrixXd h = path_->at(rows_, points * count_);
    for (Eigen::Index row = 0; row < points * count_; ++row)
      keep_path(first_ + row / points, rows_.row(row), h.row(row));
    for (Eigen::Index k = first_; k < first_ + count_; ++k) search(polynomials(k), k, Part{});
  }

  /// Keeps what a point of interval k violates. Where a constraint is not a number, the motion has left its domain.
  void keep_path(Eigen::Index k, const Eigen::RowVectorXd& point, const Eigen::RowVectorXd& h) {
    for (Eigen::Index i = 0; i < h.size(); ++i) {
      Worst& worst = violated_[static_cast<std::size_t>(i)];
      double amount = std::max(path_bounds_.lower[i] - h[i], h[i] - path_bounds_.upper[i]);
      if (!std::isfinite(h[i])) amount = infinite;
      if (amount > worst.amount) worst = {amount, k, point[2 * n_ + m_ + l_], point};
    }
  }

  /// Halves a part of interval k as long as the range of a path constraint, or of its rate, leaves room between the
  /// ends of the part for a violation that is worse than any so far.
  void search(const Polynomials& polynomials, Eigen::Index k, const Part& part) {
    const Polynomials about_middle = moved(polynomials, part.middle);
    const Eigen::RowVectorXd middle = about_middle.row(0);
    const Eigen::RowVectorXd h = path_->at(middle, 1);
    keep_path(k, middle, h);
    const std::vector<EnclosedRate> ranges = path_->on(ranges_on(about_middle, part));
    if (part.half < narrowest_part || !may_hide_worse(ranges, h, part)) return;
    const double quarter = 0.5 * part.half;
    search(polynomials, k, {part.middle - quarter, quarter});
    search(polynomials, k, {part.middle + quarter, quarter});
  }

  [[nodiscard]] bool may_hide_worse(const std::vector<EnclosedRate>& ranges, const Eigen::RowVectorXd& h,
                                    const Part& part) const {
    constexpr double worth = 1.001;
    for (Eigen::Index i = 0; i < h.size(); ++i) {
      const auto& [value, rate] = ranges[static_cast<std::size_t>(i)];
      if (!rate.contains(0.0)) continue;  // it is least and largest at the ends
      const double swing = part.half * std::max(rate.upper, -rate.lower);
      const double least = std::max(value.lower, h[i] - swing);
      const double largest = std::min(value.upper, h[i] + swing);
      const double outside = std::max(path_bounds_.lower[i] - least, largest - path_bounds_.upper[i]);
      if (outside > worth * violated_[static_cast<std::size_t>(i)].amount + finest_[i]) return true;
    }
    return false;
  }

  /// (q, v, u, y, t) of interval k.
  [[nodiscard]] Polynomials polynomials(Eigen::Index k) const {
    const Eigen::Index s = trajectory_.stages();
    const Eigen::MatrixXd v = coefficients_of_velocity_ * velocities(k);
    Polynomials all = Polynomials::Zero(std::max(s, v.rows() - 1) + 1, 2 * n_ + m_ + l_ + 1);
    const auto integrate_from = [&](Eigen::Index column, const Eigen::MatrixXd& nodes, const Eigen::MatrixXd& rates) {
      all.block(0, column, 1, nodes.cols()) = nodes.row(k);
      const Eigen::MatrixXd of_rate = coefficients_ * rates.middleRows(k * s, s);
      for (Eigen::Index i = 0; i < s; ++i) {
        all.block(i + 1, column, 1, nodes.cols()) = trajectory_.step(k) / static_cast<double>(i + 1) * of_rate.row(i);
      }
    };
    integrate_from(0, trajectory_.q, trajectory_.stage_v);
    all.block(0, n_, v.rows(), n_) = v;
    all.block(0, 2 * n_, s, m_) = coefficients_ * trajectory_.stage_u.middleRows(k * s, s);
    if (l_ > 0) integrate_from(2 * n_ + m_, trajectory_.y, trajectory_.stage_y_rates);
    all(0, 2 * n_ + m_ + l_) = trajectory_.node_times[k];
    all(1, 2 * n_ + m_ + l_) = trajectory_.step(k);
    return all;
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
    for (Eigen::Index k = 0; k < count_; ++k) {
      if (cut.col(k).maxCoeff() > largest_violation_of_a_motion) clipped_.push_back(first_ + k);
    }
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
    const std::optional<double> of_width = share_of_width(rises, worst.amount);
    const double of_depth = std::max(worst.amount / (worst.amount + descent), of_width.value_or(0.0));
    const double share = std::max(delta * worst.amount / change, worst.amount / limit(i));
    // What is rounding elsewhere may be the depth of an obstacle.
    if (worst.amount <= rounding) {
      const bool is_depth = worst.amount > rounding_of_depth * h.cwiseAbs().maxCoeff();
      return is_depth && descent + change > 0.0 && of_depth > largest_share_of_depth ? of_depth : 0.0;
    }
    if (share > delta) return share;
    if (of_depth > largest_share_of_depth) return of_depth;
    return of_width || !stays_inside(i, worst, rises) ? share : 1.0;
  }

  /// 2 p / (p + o), least over the entries, where p and o are the smallest displacements of an entry to either side
  /// that make up for a violation: how deep in an obstacle a point is, whatever its formula. 0 where only one side
  /// leads out of it, by δ or less; none where no entry does.
  [[nodiscard]] static std::optional<double> share_of_width(const Eigen::VectorXd& rises, double amount) {
    constexpr double by_delta = 1.0 / largest_displacement;
    std::optional<double> least;
    for (Eigen::Index first = 0; first + 1 < rises.size(); first += 2 * displacements) {
      std::array<double, 2> nearest{infinite, infinite};
      for (Eigen::Index row = 0; row < 2 * displacements; ++row) {
        if (rises[first + row] >= amount)
          nearest[static_cast<std::size_t>(row % 2)] = std::ldexp(1.0, -static_cast<int>(row / 2));
      }
      const auto [near, far] = std::minmax(nearest[0], nearest[1]);
      if (std::isinf(far) && near > by_delta) continue;
      least = std::min(least.value_or(infinite), std::isinf(far) ? 0.0 : 2.0 * near / (near + far));
    }
    return least;
  }

  /// Whether a violation remains, and falls to the last, as all entries move up to δ of their ranges to the side where
  /// each alone makes h_i rise more: next to a pole of h_i, what they change it by is large and makes up for nothing.
  [[nodiscard]] bool stays_inside(Eigen::Index i, const Worst& worst, const Eigen::VectorXd& rises) {
    const Eigen::Index moved = scales_.size();
    Eigen::MatrixXd rows = worst.point.replicate(displacements, 1);  // the last one stays
    for (Eigen::Index j = 0; j < moved; ++j) {
      const auto by_delta = rises.segment<2>(2 * (displacements * j + displacement_by_delta));
      double size = largest_violation_of_a_motion * scales_[j] * (by_delta[0] >= by_delta[1] ? 1.0 : -1.0);
      for (Eigen::Index row = 0; row + 1 < displacements; ++row, size *= 0.5) rows(row, j) += size;
    }
    const Eigen::VectorXd h = path_->at(rows, displacements).col(i);
    const double sign = h[displacements - 1] > path_bounds_.upper[i] ? -1.0 : 1.0;
    const Eigen::VectorXd risen = sign * (h.array() - h[displacements - 1]);
    return risen.maxCoeff() < worst.amount && risen[0] >= risen.maxCoeff();
  }

  /// The largest bound of path constraint i, infinite where it has none but 0.
  [[nodiscard]] double limit(Eigen::Index i) const {
    double largest = 0.0;
    for (const double bound : {path_bounds_.lower[i], path_bounds_.upper[i]}) {
      if (std::isfinite(bound)) largest = std::max(largest, std::abs(bound));
    }
    if (largest == 0.0) return infinite;
    return largest;
  }

  /// (q, v, u, y, t) at the points of interval k, (q, v, y) by the cubic polynomials through both nodes and the rates.
  [[nodiscard]] Eigen::MatrixXd cubic(EquationsOfMotion& motion, Eigen::Index k) const {
    const double h = trajectory_.step(k);
    const Eigen::MatrixXd left = state_and_rate(motion, trajectory_, k, k);
    const Eigen::MatrixXd right = state_and_rate(motion, trajectory_, k + 1, k);
    Eigen::MatrixXd rows(points, rows_.cols());
    for (Eigen::Index i = 0; i < points; ++i) {
      const double tau = tau_of(i);
      const double rest = 1.0 - tau;
      const double t = trajectory_.node_times[k] + tau * h;
      const Eigen::VectorXd x = rest * rest * ((1.0 + 2.0 * tau) * left.col(0) + h * tau * left.col(1)) +
                                tau * tau * ((1.0 + 2.0 * rest) * right.col(0) - h * rest * right.col(1));
      rows.row(i) << x.head(2 * n_).transpose(), control_on_interval(trajectory_, k, t).transpose(),
          x.tail(l_).transpose(), t;
    }
    return rows;
  }

  /// What all excesses together add to the cost, and the one that adds most; see `MotionViolation::is_priced`.
  [[nodiscard]] MotionViolation priced() {
    constexpr double smallest_cost = 1e-6;  // below it round-off and the tolerance decide
    MotionViolation found;
    const Eigen::MatrixXd prices = prices_of_intervals(trajectory_, std::ssize(violated_));
    if (prices.isZero(0.0) || traced_.has_embedding()) return found;
    EquationsOfMotion motion(traced_);
    double largest = 0.0;
    double sum = 0.0;
    const auto add = [&](Eigen::Index k, Eigen::Index j, double lower, double upper, const Eigen::VectorXd& values,
                         const Eigen::VectorXd& times) {
      Eigen::Index at = 0;
      const double excess = prices(k, j) > 0.0 ? lower - values.minCoeff(&at) : values.maxCoeff(&at) - upper;
      const double worth = std::abs(prices(k, j)) * excess;
      if (!(worth > 0.0) || std::isinf(worth)) return;
      sum += worth;
      if (worth <= largest) return;
      largest = worth;
      const Eigen::Index bounds = scales_.size();
      found = {0.0, excess, j < bounds ? name_of_bound(j) : name_of_path(j - bounds), j < bounds, true, k, times[at]};
    };
    for (Eigen::Index k = 0; k < trajectory_.intervals(); ++k) {
      if (prices.row(k).isZero(0.0)) continue;
      try {
        const Eigen::MatrixXd rows = cubic(motion, k);
        const Eigen::VectorXd times = rows.rightCols(1);
        for (Eigen::Index j = 0; j < scales_.size(); ++j) add(k, j, lower_[j], upper_[j], rows.col(j), times);
        if (!path_) continue;
        const Eigen::MatrixXd h = path_->at(rows, points);
        for (Eigen::Index i = 0; i < h.cols(); ++i) {
          add(k, scales_.size() + i, path_bounds_.lower[i], path_bounds_.upper[i], h.col(i), times);
        }
      } catch (const Error&) {  // L_vv is singular at a node
      }
    }
    found.share = share_per_added_cost * sum / std::max(std::abs(trajectory_.cost), smallest_cost);
    return found;
  }

  [[nodiscard]] ViolationBetweenStages summary() {
    ViolationBetweenStages found;
    const auto take = [&](MotionViolation& kept, double share, const Worst& worst, const std::string& name,
                          bool is_bound) {
      if (share > kept.share) kept = {share, worst.amount, name, is_bound, false, worst.interval, worst.time};
    };
    for (Eigen::Index j = 0; j < scales_.size(); ++j) {
      const Worst& worst = outside_[static_cast<std::size_t>(j)];
      found.largest = std::max(found.largest, worst.amount);
      if (worst.amount <= tolerated(scales_[j])) continue;
      take(is_control(j) ? found.control : found.state, worst.amount / scales_[j], worst, name_of_bound(j), true);
    }
    found.control.share = clipped_share_;
    found.missed = missed_;
    found.intervals_of_control = clipped_;
    for (Eigen::Index i = 0; i < std::ssize(violated_); ++i) {
      const Worst& worst = violated_[static_cast<std::size_t>(i)];
      found.largest = std::max(found.largest, worst.amount);
      if (worst.amount > 0.0) take(found.state, path_share(i, worst), worst, name_of_path(i), false);
    }
    if (MotionViolation worst = priced(); worst.share > found.state.share) found.state = std::move(worst);
    return found;
  }

  const Problem& problem_;
  const TracedProblem& traced_;
  const Trajectory& trajectory_;
  Eigen::Index n_;
  Eigen::Index m_;
  Eigen::Index l_;
  PolynomialsAtPoints basis_;
  Eigen::VectorXd times_of_velocity_;
  PolynomialsAtPoints basis_of_velocity_;
  Eigen::MatrixXd coefficients_;
  Eigen::MatrixXd coefficients_of_velocity_;
  Eigen::MatrixXd rows_;   // (q, v, u, y, t) at the points of the present intervals
  Eigen::VectorXd lower_;  // of (q, v, u, y)
  Eigen::VectorXd upper_;
  Eigen::VectorXd scales_;  // of (q, v, u, y)
  Ranges range_of_q_;
  Ranges range_of_v_;
  std::vector<Worst> outside_;
  std::unique_ptr<PathConstraints> path_;  // none without path constraints
  Bounds path_bounds_;
  std::vector<Worst> violated_;  // path constraints
  Eigen::VectorXd finest_;       // of every path constraint
  Eigen::Index first_ = 0;
  Eigen::Index count_ = 0;
  bool has_excess_ = false;
  double clipped_share_ = 0.0;
  double missed_ = 0.0;
  std::vector<Eigen::Index> clipped_;
};

}  // namespace

bool ViolationBetweenStages::keeps_state() const { return state.share <= largest_violation_of_a_motion; }

bool ViolationBetweenStages::keeps_controls() const {
  return control.share <= largest_violation_of_a_motion || missed <= smallest_miss;
}

std::string ViolationBetweenStages::words(const Problem& problem, const Trajectory& trajectory) const {
  std::string text;
  const auto add = [&](const MotionViolation& worst, const std::string& size) {
    text += fmt::format(" {} is violated by {:.2g} at {} (interval {}){}.", worst.constraint, worst.size,
                        time_in_words(problem, worst.time), worst.interval, size);
  };
  if (!keeps_state() && state.is_priced) {
    add(state,
        fmt::format(". If it held between the points of the grid too, the cost would grow by about {:.2g} %. "
                    "If the cost grows with the number of intervals, there may be no trajectory within the bounds",
                    100.0 * state.share / share_per_added_cost));
  } else if (!keeps_state()) {
    add(state, state.share > 1.0 ? ", more than its scale" : fmt::format(", {:.2g} of its scale", state.share));
  }
  if (!keeps_controls()) {
    add(control,
        fmt::format("; clipping the controls to their bounds moves the final state by {:.1e} of its range", missed));
  }
  // At a switch of a control more intervals hardly help.
  if (keeps_state()) {
    return text +
           " Use --method galerkin --control-nodes 1 or --stages 1, with which controls are constant in each interval, "
           "or --accuracy, which shortens the intervals in which controls switch.";
  }
  const Eigen::VectorXd& c = trajectory.tableau.c;
  const bool are_stages_inside = c.minCoeff() > 0.0 || c.maxCoeff() < 1.0;
  return fmt::format("{} Use more intervals{}{}.", text,
                     trajectory.stages() > 1 && state.is_bound ? ", --stages 1" : "",
                     !are_stages_inside         ? ""
                     : trajectory.stages() == 1 ? ", or --tableau lobatto --stages 2"
                                                : ", or --tableau lobatto");
}

ViolationBetweenStages violation_between_stages(const Problem& problem, const TracedProblem& traced,
                                                const Trajectory& trajectory) {
  const ProblemBounds bounds = problem.bounds();
  // With one stage u is constant in an interval.
  const bool may_leave_bounds =
      bounds.q.any() || bounds.v.any() || bounds.y.any() || (bounds.u.any() && trajectory.stages() > 1);
  if (!may_leave_bounds && traced.path_constraint_count() == 0) return {};
  return Measurement(problem, bounds, traced, trajectory).measured();
}

}  // namespace dmocbench
