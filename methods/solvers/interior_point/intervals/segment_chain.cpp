#include "methods/solvers/interior_point/intervals/segment_chain.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace dmocbench::interior_point {

namespace {

/// L with Γ = LLᵀ for a matrix that is positive semidefinite up to rounding: a pivot that has vanished leaves a column
/// of zeros.
Eigen::MatrixXd semidefinite_factor(const Eigen::MatrixXd& gamma) {
  const Eigen::Index n = gamma.rows();
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double pivot = gamma(j, j) - factor.row(j).head(j).squaredNorm();
    if (!(pivot > static_cast<double>(n) * std::numeric_limits<double>::epsilon() * gamma(j, j))) continue;
    factor(j, j) = std::sqrt(pivot);
    for (Eigen::Index i = j + 1; i < n; ++i) {
      factor(i, j) = (gamma(i, j) - factor.row(i).head(j).dot(factor.row(j).head(j))) / factor(j, j);
    }
  }
  return factor;
}

void symmetrise(Eigen::MatrixXd& matrix) { matrix = (0.5 * (matrix + matrix.transpose())).eval(); }

}  // namespace

void SegmentChain::start(const SegmentValue& last, const Eigen::VectorXd& terminal_weights) {
  terminal_weights_ = terminal_weights;
  total_ = last;
  joins_.clear();
}

bool SegmentChain::join(const SegmentValue& segment) {
  const Eigen::Index n = total_.P.rows();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  Join join;
  join.slope = total_.P;
  join.slope.diagonal() -= terminal_weights_;
  join.mixed = total_.Phi;
  join.constant = total_.p;
  // The state y between and the multiplier ν' of the segment in front make (slope, -I; -I, -Γ): two such blocks have
  // the inertia of a minimum exactly if I + Lᵀ slope L is positive definite.
  const Eigen::MatrixXd factor = semidefinite_factor(segment.Gamma);
  if (Eigen::LLT<Eigen::MatrixXd>(identity + factor.transpose() * join.slope * factor).info() != Eigen::Success) {
    return false;
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> system(identity + segment.Gamma * join.slope);
  join.state_state = system.solve(segment.Phi.transpose());
  join.state_multiplier = -system.solve(segment.Gamma * join.mixed);
  join.state_constant = system.solve(segment.gamma - segment.Gamma * join.constant);

  total_.gamma += join.mixed.transpose() * join.state_constant;
  total_.Gamma -= join.mixed.transpose() * join.state_multiplier;
  symmetrise(total_.Gamma);
  total_.p = segment.p + segment.Phi * (join.slope * join.state_constant + join.constant);
  total_.Phi = segment.Phi * (join.mixed + join.slope * join.state_multiplier);
  total_.P = segment.P + segment.Phi * join.slope * join.state_state;
  symmetrise(total_.P);
  joins_.push_back(std::move(join));
  return true;
}

void SegmentChain::spread(const Eigen::VectorXd& state, const Eigen::VectorXd& multiplier, Eigen::MatrixXd& states,
                          Eigen::MatrixXd& multipliers) const {
  states.resize(state.size(), static_cast<Eigen::Index>(joins_.size()) + 1);
  multipliers.resizeLike(states);
  states.col(0) = state;
  for (std::size_t s = 0; s < joins_.size(); ++s) {
    const Join& join = joins_[joins_.size() - 1 - s];
    const auto column = static_cast<Eigen::Index>(s);
    states.col(column + 1) =
        join.state_state * states.col(column) + join.state_multiplier * multiplier + join.state_constant;
    multipliers.col(column) = join.slope * states.col(column + 1) + join.mixed * multiplier + join.constant;
  }
  multipliers.rightCols(1) = multiplier;
}

}  // namespace dmocbench::interior_point
