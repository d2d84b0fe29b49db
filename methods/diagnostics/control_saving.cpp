#include "methods/diagnostics/control_saving.hpp"

#include <algorithm>

#include <Eigen/Core>
#include <boost/math/quadrature/gauss.hpp>

#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

namespace {

/// What H at one time is a sum of, C, f, g, the integrands, u and the path constraints, with the first and second
/// derivatives by each control: a row per term, 1 + 2m columns.
ExpressionVector terms_of_hamiltonian(const TracedProblem& traced, const ControlledState& x) {
  const TracedProblem::Values values = traced.at(x);
  const Eigen::Index m = x.u.size();
  ExpressionVector terms(1 + values.control_force.size() + values.first_order_rates.size() + values.integrands.size() +
                         m + values.path_constraints.size());
  terms << values.running_cost, values.control_force, values.first_order_rates, values.integrands, x.u,
      values.path_constraints;
  ExpressionMatrix table(terms.size(), 1 + 2 * m);
  table.leftCols(1 + m) << terms, jacobian(terms, x.u);
  for (Eigen::Index j = 0; j < m; ++j) table.col(1 + m + j) = jacobian(table.col(1 + j), x.u.segment(j, 1));
  return table.reshaped();
}

/// H at one time of an interval, as a function of u; see `control_saving`.
class HamiltonianOfControl {
 public:
  HamiltonianOfControl(const TracedProblem& traced, const Trajectory& trajectory)
      : trajectory_(trajectory),
        terms_(
            traced.configuration_size(), traced.control_size(),
            [&](const ControlledState& x) { return terms_of_hamiltonian(traced, x); }, traced.first_order_size()),
        values_(terms_.output_count() / (1 + 2 * traced.control_size()), 1 + 2 * traced.control_size()),
        weights_(values_.rows()),
        sizes_(trajectory.stage_u.cwiseAbs().colwise().maxCoeff().transpose()) {
    sizes_ = (sizes_.array() > 0.0).select(sizes_, 1.0);
  }

  /// H(u) - H(u + δu) at a time of interval k; 0 where δu does not lower H.
  [[nodiscard]] double saving(Eigen::Index k, double t) {
    set_time(k, t);
    constexpr double flattest = 1e-4;  // H_uu for the whole size of a control, as a share of the terms of H
    constexpr double farthest = 10.0;  // of these sizes
    const Eigen::VectorXd here = at(point_.u);
    const double terms = values_.col(0).cwiseAbs().dot(weights_.cwiseAbs());  // their sum may vanish
    Eigen::VectorXd better = point_.u;
    for (Eigen::Index j = 0; j < better.size(); ++j) {
      const double slope = here[1 + j] * sizes_[j];
      const double curvature = here[1 + better.size() + j] * sizes_[j] * sizes_[j];
      if (curvature > flattest * terms) better[j] -= std::clamp(slope / curvature, -farthest, farthest) * sizes_[j];
    }
    return std::max(0.0, here[0] - at(better)[0]);
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
    append(-of_stages(trajectory_.prices.stage_u), point_.u.size());
    append(-of_stages(trajectory_.prices.path), weights_.size() - first);
  }

  /// H, H_{u_j} for every j, then H_{u_j u_j}.
  [[nodiscard]] Eigen::VectorXd at(const Eigen::VectorXd& u) {
    terms_.evaluate(point_.q, point_.v, u, t_, values_.reshaped(), point_.y);
    return values_.transpose() * weights_;
  }

  const Trajectory& trajectory_;
  PointFunction terms_;
  Eigen::MatrixXd values_;  // of the terms and their derivatives
  Eigen::VectorXd weights_;
  Eigen::VectorXd sizes_;
  MotionPoint point_;
  double t_ = 0.0;
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
