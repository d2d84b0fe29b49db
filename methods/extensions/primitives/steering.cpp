#include "methods/extensions/primitives/steering.hpp"

#include <cmath>

#include <Eigen/QR>

namespace dmocbench {

namespace {

/// ∂(end)/∂(all controls) of one state, 2n × (intervals · m), from the derivatives of each of its steps.
Eigen::MatrixXd response_of(const std::vector<Eigen::MatrixXd>& derivatives, Eigen::Index state, Eigen::Index n,
                            Eigen::Index m) {
  const auto intervals = static_cast<Eigen::Index>(derivatives.size());
  Eigen::MatrixXd response(2 * n, intervals * m);
  Eigen::MatrixXd onwards = Eigen::MatrixXd::Identity(2 * n, 2 * n);  // from the end of the interval to the last node
  for (Eigen::Index k = intervals - 1; k >= 0; --k) {
    const Eigen::VectorXd entries = derivatives[static_cast<std::size_t>(k)].row(state).transpose();
    response.middleCols(k * m, m) = onwards * entries.tail(2 * n * m).reshaped(2 * n, m);
    onwards = (onwards * entries.head(4 * n * n).reshaped(2 * n, 2 * n)).eval();
  }
  return response;
}

}  // namespace

Eigen::MatrixXd Steering::deviations(const Eigen::VectorXd& miss) const {
  return (law_ * miss).reshaped(controls_, law_.rows() / controls_).transpose();
}

std::vector<Steering> steerings(const DiscreteFlow& flow, const Eigen::MatrixXd& states, const Eigen::VectorXd& u,
                                int intervals) {
  const Eigen::Index n = flow.configuration_size();
  const Eigen::Index m = flow.control_size();
  const Eigen::MatrixXd controls = u.transpose().replicate(states.rows(), 1);
  Eigen::MatrixXd ends = states;
  Eigen::VectorXd costs = Eigen::VectorXd::Zero(states.rows());
  std::vector<Eigen::MatrixXd> derivatives;
  for (int k = 0; k < intervals; ++k) {
    derivatives.push_back(flow.derivatives(ends, controls));
    flow.advance(ends, controls, costs);
  }
  std::vector<Steering> result(static_cast<std::size_t>(states.rows()));
  for (Eigen::Index i = 0; i < states.rows(); ++i) {
    // δU = Q T⁻ᵀ miss with responseᵀ = Q T, of full rank.
    Steering& steering = result[static_cast<std::size_t>(i)];
    const Eigen::MatrixXd response = response_of(derivatives, i, n, m);
    const Eigen::HouseholderQR<Eigen::MatrixXd> factors(response.transpose());
    const Eigen::MatrixXd q = factors.householderQ() * Eigen::MatrixXd::Identity(intervals * m, 2 * n);
    const Eigen::MatrixXd t = factors.matrixQR().topRows(2 * n).triangularView<Eigen::Upper>();
    const Eigen::MatrixXd inverse =
        t.transpose().triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(2 * n, 2 * n));
    steering.end_ = ends.row(i).transpose();
    steering.root_ = std::sqrt(0.5 * std::abs(flow.step())) * inverse;
    steering.law_ = q * inverse;
    steering.controls_ = m;
  }
  return result;
}

}  // namespace dmocbench
