#include "methods/transcription/motions/interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <boost/math/interpolators/cubic_hermite.hpp>

#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/points_along.hpp"

namespace dmocbench {

namespace {

/// Two times on different grids are the same if they differ by less than this share of the horizon.
constexpr double rounding_of_times = 1e-12;

/// The interval that contains t; the nearest one outside the horizon.
Eigen::Index interval_of(const Eigen::VectorXd& times, double t) {
  const auto above = std::upper_bound(times.begin(), times.end(), t);
  return std::clamp<Eigen::Index>(above - times.begin() - 1, 0, times.size() - 2);
}

/// The interval of a node or of any other time on that side of it.
Eigen::Index interval_on_side(const Eigen::VectorXd& times, double t, Side side) {
  const double nudge = rounding_of_times * (times[times.size() - 1] - times[0]);
  return interval_of(times, side == Side::left ? t - nudge : t + nudge);
}

/// The polynomial through the stages of an interval, from their table.
Eigen::VectorXd stage_polynomial(const Trajectory& trajectory, const Eigen::MatrixXd& stages, Eigen::Index interval,
                                 double t) {
  const Eigen::Index s = trajectory.stages();
  const double left = trajectory.node_times[interval];
  const double tau = (t - left) / (trajectory.node_times[interval + 1] - left);
  return stages.middleRows(interval * s, s).transpose() * lagrange_basis(trajectory.tableau.c, tau);
}

}  // namespace

std::optional<Eigen::Index> node_at(const Eigen::VectorXd& times, double t) {
  const double span = times[times.size() - 1] - times[0];
  const auto above = std::lower_bound(times.begin(), times.end(), t - rounding_of_times * span);
  if (above == times.end() || std::abs(*above - t) > rounding_of_times * span) return std::nullopt;
  return above - times.begin();
}

Eigen::VectorXd configuration_at(const Trajectory& trajectory, double t) {
  const Eigen::Index k = interval_of(trajectory.node_times, t);
  const double h = trajectory.step(k);
  const double tau = std::clamp((t - trajectory.node_times[k]) / h, 0.0, 1.0);
  if (tau == 0.0) return trajectory.q.row(k).transpose();
  if (tau == 1.0) return trajectory.q.row(k + 1).transpose();
  const Eigen::Index s = trajectory.stages();
  const auto rates = trajectory.stage_v.middleRows(k * s, s);
  return trajectory.q.row(k).transpose() + h * rates.transpose() * lagrange_integral(trajectory.tableau.c, tau);
}

Eigen::VectorXd control_on_interval(const Trajectory& trajectory, Eigen::Index interval, double t) {
  return stage_polynomial(trajectory, trajectory.stage_u, interval, t);
}

Eigen::VectorXd velocity_on_interval(const Trajectory& trajectory, Eigen::Index interval, double t) {
  return stage_polynomial(trajectory, trajectory.stage_v, interval, t);
}

Eigen::VectorXd first_order_on_interval(const Trajectory& trajectory, Eigen::Index interval, double t) {
  if (trajectory.y.cols() == 0) return {};
  const double h = trajectory.step(interval);
  const Eigen::VectorXd weights =
      h * lagrange_integral(trajectory.tableau.c, (t - trajectory.node_times[interval]) / h);
  const Eigen::Index s = trajectory.stages();
  return trajectory.y.row(interval).transpose() +
         trajectory.stage_y_rates.middleRows(interval * s, s).transpose() * weights;
}

Eigen::VectorXd control_at(const Trajectory& trajectory, double t, Side side) {
  if (trajectory.stages() > 1) {
    return control_on_interval(trajectory, interval_on_side(trajectory.node_times, t, side), t);
  }
  if (trajectory.intervals() == 1) return trajectory.stage_u.row(0).transpose();
  const Eigen::Index k = interval_of(trajectory.stage_times, t);
  const double left = trajectory.stage_times[k];
  const double weight = (t - left) / (trajectory.stage_times[k + 1] - left);
  return (1.0 - weight) * trajectory.stage_u.row(k).transpose() + weight * trajectory.stage_u.row(k + 1).transpose();
}

Eigen::VectorXd reference_control_at(const Trajectory& trajectory, double t, Side side) {
  const Eigen::VectorXd& times = trajectory.stage_times;
  const Eigen::Index s = trajectory.stages();
  const Eigen::Index k = interval_on_side(trajectory.node_times, t, side);
  // Lobatto stages of two intervals share the time of a node.
  const bool shares_nodes = trajectory.tableau.c[0] == 0.0 && trajectory.tableau.c[s - 1] == 1.0;
  const Eigen::Index away = shares_nodes ? 2 : 1;
  std::vector<Eigen::Index> stages;
  if (k > 0) stages.push_back(k * s - away);
  for (Eigen::Index i = 0; i < s; ++i) stages.push_back(k * s + i);
  if (k + 1 < trajectory.intervals()) stages.push_back((k + 1) * s - 1 + away);
  const double step = trajectory.step(k);
  Eigen::VectorXd places = (times(stages).array() - trajectory.node_times[k]) / step;
  return trajectory.stage_u(stages, Eigen::all).transpose() *
         lagrange_basis(places, (t - trajectory.node_times[k]) / step);
}

Motion smooth_motion(const Trajectory& trajectory) {
  using Interpolator = boost::math::interpolators::cubic_hermite<std::vector<double>>;
  const auto column = [](const auto& values) { return std::vector<double>(values.begin(), values.end()); };
  const auto curves = std::make_shared<std::vector<Interpolator>>();
  for (Eigen::Index i = 0; i < trajectory.q.cols(); ++i) {
    curves->emplace_back(column(trajectory.node_times), column(trajectory.q.col(i)), column(trajectory.v.col(i)));
  }
  const auto at = [curves, trajectory](double t) {
    const double inside =
        std::clamp(t, trajectory.node_times[0], trajectory.node_times[trajectory.node_times.size() - 1]);
    const auto n = static_cast<Eigen::Index>(curves->size());
    MotionPoint point{Eigen::VectorXd(n), Eigen::VectorXd(n), control_at(trajectory, inside), {}};
    if (trajectory.y.cols() > 0) {
      const Eigen::Index k = interval_of(trajectory.node_times, inside);
      const double tau = (inside - trajectory.node_times[k]) / trajectory.step(k);
      point.y = ((1.0 - tau) * trajectory.y.row(k) + tau * trajectory.y.row(k + 1)).transpose();
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      const Interpolator& curve = (*curves)[static_cast<std::size_t>(i)];
      point.q[i] = curve(inside);
      point.v[i] = curve.prime(inside);
    }
    return point;
  };
  return {at, trajectory.node_times[trajectory.node_times.size() - 1], trajectory.unknowns};
}

Motion bent(const Motion& motion, const Eigen::MatrixXd& amplitudes, const Eigen::MatrixXd& of_control) {
  const auto at = [motion, amplitudes, of_control](double t) {
    MotionPoint point = motion.at(t);
    for (Eigen::Index k = 0; k < amplitudes.cols(); ++k) {
      const double frequency = static_cast<double>(k + 1) * std::numbers::pi / motion.horizon;
      point.q += amplitudes.col(k) * std::sin(frequency * t);
      point.v += amplitudes.col(k) * (frequency * std::cos(frequency * t));
    }
    for (Eigen::Index k = 0; k < of_control.cols(); ++k) {
      point.u += of_control.col(k) * std::cos(static_cast<double>(k) * std::numbers::pi * t / motion.horizon);
    }
    return point;
  };
  return {at, motion.horizon, motion.unknowns};
}

namespace {

/// The values that bounds fix minus a state's; 0 for free entries.
Eigen::VectorXd missing(const Bounds& bounds, const Eigen::VectorXd& values) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (bounds.is_fixed(i)) result[i] = bounds.lower[i] - values[i];
  }
  return result;
}

/// The fixed state of an end minus a point of a motion.
BoundaryState missing(const EndBounds& end, const MotionPoint& point) {
  return {.q = missing(end.q, point.q), .v = missing(end.v, point.v), .y = missing(end.y, point.y)};
}

}  // namespace

Motion moved_to_ends(const Motion& motion, const ProblemBounds& bounds) {
  const double horizon = motion.horizon;
  const BoundaryState first = missing(bounds.first, motion.at(0.0));
  const BoundaryState last = missing(bounds.last, motion.at(horizon));
  const auto at = [=](double t) {
    const double s = t / horizon;
    const double r = 1.0 - s;
    MotionPoint point = motion.at(t);
    point.q += r * r * ((1.0 + 2.0 * s) * first.q + s * horizon * first.v);
    point.q += s * s * ((1.0 + 2.0 * r) * last.q - r * horizon * last.v);
    point.v += 6.0 * s * r / horizon * (last.q - first.q);
    point.y += r * first.y + s * last.y;
    point.v += r * (1.0 - 3.0 * s) * first.v + s * (3.0 * s - 2.0) * last.v;
    return point;
  };
  return {at, horizon, motion.unknowns};
}

}  // namespace dmocbench
