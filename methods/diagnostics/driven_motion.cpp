#include "methods/diagnostics/driven_motion.hpp"

#include "methods/error.hpp"
#include "methods/numerics/adaptive_integration.hpp"

namespace dmocbench {

DrivenMotion::DrivenMotion(const Problem& problem, double tolerance)
    : tolerance_(tolerance),
      n_(problem.configuration_size()),
      l_(problem.first_order_size()),
      traced_(problem),
      motion_(traced_),
      running_cost_(
          problem, [&](const ControlledState& x) { return ExpressionVector::Constant(1, traced_.at(x).running_cost); }),
      final_cost_(problem, [&](const ControlledState& x) {
        return ExpressionVector::Constant(1, problem.final_cost(x.state()));
      }) {
  if (traced_.constraint_count() > 0) constraints_.emplace(traced_);
}

void DrivenMotion::begin_at(const BoundaryState& start) {
  state_.assign(start.q.begin(), start.q.end());
  state_.insert(state_.end(), start.v.begin(), start.v.end());
  state_.insert(state_.end(), start.y.begin(), start.y.end());
  state_.push_back(0.0);
}

void DrivenMotion::carry(const Control& control, double from, double to) {
  const auto equations = [&](const std::vector<double>& x, std::vector<double>& derivative, double t) {
    const Eigen::Map<const Eigen::VectorXd> q(x.data(), n_);
    const Eigen::Map<const Eigen::VectorXd> v(x.data() + n_, n_);
    const Eigen::Map<const Eigen::VectorXd> y(x.data() + 2 * n_, l_);
    const Eigen::VectorXd u = control(t);
    motion_.write_rate(x, u, t, derivative);
    running_cost_.evaluate(q, v, u, t, cost_, y);
    derivative.back() = cost_[0];
  };
  if (!integrate(equations, state_, from, to, to - from, tolerance_)) {
    throw Error("the step size of the exact motion vanished between t = {} and {}", from, to);
  }
  if (!Eigen::Map<const Eigen::VectorXd>(state_.data(), std::ssize(state_)).allFinite()) {
    throw Error("the exact motion left the domain of its equations between t = {} and {}", from, to);
  }
  if (constraints_) {
    constraints_->project(Eigen::Map<Eigen::VectorXd>(state_.data(), n_),
                          Eigen::Map<Eigen::VectorXd>(state_.data() + n_, n_));
  }
}

BoundaryState DrivenMotion::state() const {
  return {.q = Eigen::Map<const Eigen::VectorXd>(state_.data(), n_),
          .v = Eigen::Map<const Eigen::VectorXd>(state_.data() + n_, n_),
          .y = Eigen::Map<const Eigen::VectorXd>(state_.data() + 2 * n_, l_)};
}

double DrivenMotion::final_cost(double t) {
  const BoundaryState last = state();
  final_cost_.evaluate(last.q, last.v, Eigen::VectorXd(), t, cost_, last.y);
  return cost_[0];
}

}  // namespace dmocbench
