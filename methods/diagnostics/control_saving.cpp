#include "methods/diagnostics/control_saving.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <boost/math/quadrature/gauss.hpp>

#include "methods/mechanics/point_function.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

namespace {

/// What H at one time is a sum of: C, f, g, then the integrands and the path constraints.
ExpressionVector terms_of_hamiltonian(const TracedProblem& traced, const ControlledState& x) {
  const TracedProblem::Values values = traced.at(x);
  ExpressionVector terms(1 + values.control_force.size() + values.first_order_rates.size() + values.integrands.size() +
                         values.path_constraints.size());
  terms << values.running_cost, values.control_force, values.first_order_rates, values.integrands,
      values.path_constraints;
  return terms;
}

/// H at one time of an interval, as a function of u; see `control_saving`.
class HamiltonianOfControl {
 public:
  HamiltonianOfControl(const TracedProblem& traced, const Trajectory& trajectory)
      : trajectory_(trajectory),
        terms_(
            traced.configuration_size(), traced.control_size(),
            [&](const ControlledState& x) { return terms_of_hamiltonian(traced, x); }, traced.first_order_size()),
        values_(terms_.output_count()),
        weights_(terms_.output_count()),
        sizes_(trajectory.stage_u.cwiseAbs().colwise().maxCoeff().transpose()) {
    sizes_ = (sizes_.array() > 0.0).select(sizes_, 1.0);
  }

  /// H(u) - H(u + δu) at a time of interval k; 0 where δu does not lower H.
  [[nodiscard]] double saving(Eigen::Index k, double t) {
    set_time(k, t);
    constexpr double difference = 1e-3;  // these are shares of the size of a control
    constexpr double flattest = 1e-4;    // second difference of H for the whole size, as a share of its terms
    constexpr double farthest = 10.0;
    const Eigen::VectorXd u = point_.u;
    const double here = at(u);
    Eigen::VectorXd better = u;
    for (Eigen::Index j = 0; j < u.size(); ++j) {
      const auto moved = [&](double share) {
        Eigen::VectorXd other = u;
        other[j] += share * sizes_[j];
        return at(other);
      };
      const double above = moved(difference);
      const double terms = values_.cwiseAbs().dot(weights_.cwiseAbs());  // their sum may vanish, and all of them at u
      const double below = moved(-difference);
      const double slope = (above - below) / (2.0 * difference);
      const double curvature = (above - 2.0 * here + below) / (difference * difference);
      if (!(curvature > flattest * terms)) continue;
      better[j] -= std::clamp(slope / curvature, -farthest, farthest) * sizes_[j];
    }
    return std::max(0.0, here - at(better));
  }

 private:
  /// Sets the state and the weights, which are the costates and minus the prices.
  void set_time(Eigen::Index k, double t) {
    t_ = t;
    const double tau = (t - trajectory_.node_times[k]) / trajectory_.step(k);
    const Eigen::VectorXd basis = lagrange_basis(trajectory_.tableau.c, tau);
    const auto of_stages = [&](const Eigen::MatrixXd& table) -> Eigen::VectorXd {
      if (table.cols() == 0) return {};
      return table.middleRows(k * basis.size(), basis.size()).transpose() * basis;
    };
    const auto of_nodes = [&](const Eigen::MatrixXd& table) -> Eigen::VectorXd {
      return (1.0 - tau) * Trajectory::row_of(table, k) + tau * Trajectory::row_of(table, k + 1);
    };
    point_ = {configuration_at(trajectory_, t), velocity_on_interval(trajectory_, k, t),
              control_on_interval(trajectory_, k, t), first_order_on_interval(trajectory_, k, t)};
    price_of_u_ = of_stages(trajectory_.prices.stage_u);
    weights_.setZero();
    weights_[0] = 1.0;
    Eigen::Index first = 1;
    const auto append = [&](const Eigen::VectorXd& weights, Eigen::Index count) {
      if (weights.size() == count) weights_.segment(first, count) = weights;
      first += count;
    };
    append(of_nodes(trajectory_.psi_p), point_.q.size());
    append(of_nodes(trajectory_.psi_y), point_.y.size());
    append(-trajectory_.integral_prices, trajectory_.integrals.size());
    append(-of_stages(trajectory_.prices.path), weights_.size() - first);
  }

  [[nodiscard]] double at(const Eigen::VectorXd& u) {
    terms_.evaluate(point_.q, point_.v, u, t_, values_, point_.y);
    return values_.dot(weights_) - (price_of_u_.size() > 0 ? price_of_u_.dot(u) : 0.0);
  }

  const Trajectory& trajectory_;
  PointFunction terms_;
  Eigen::VectorXd values_;
  Eigen::VectorXd weights_;
  Eigen::VectorXd sizes_;
  MotionPoint point_;
  double t_ = 0.0;
  Eigen::VectorXd price_of_u_;
};

}  // namespace

double control_saving(const TracedProblem& traced, const Trajectory& trajectory) {
  if (!trajectory.has_costates() || traced.constraint_count() > 0 || traced.has_embedding()) return 0.0;
  HamiltonianOfControl hamiltonian(traced, trajectory);
  double saving = 0.0;
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    stop_if_requested();
    const double left = trajectory.node_times[k];
    saving += boost::math::quadrature::gauss<double, 7>::integrate([&](double t) { return hamiltonian.saving(k, t); },
                                                                   left, left + trajectory.step(k));
  }
  return saving;
}

}  // namespace dmocbench
