#include "methods/solvers/sqp/hessians.hpp"

#include <algorithm>
#include <cmath>

#include "methods/kkt/linearisation.hpp"

namespace dmocbench::sqp {

std::optional<double> Convexification::shift_for(const Eigen::SparseMatrix<double>& hessian,
                                                 const Eigen::SparseMatrix<double>& jacobian,
                                                 const std::vector<bool>& free, const std::vector<bool>& equalities,
                                                 const std::function<bool()>& is_stopped) {
  const auto is_enough = [&](double shift) {
    return factorisation_.factorise(kkt_matrix(hessian, shift, jacobian, free, equalities)) &&
           factorisation_.negative_eigenvalues() == jacobian.rows();
  };
  if (is_enough(0.0)) return 0.0;
  double size = 1.0;
  for (Eigen::Index e = 0; e < hessian.nonZeros(); ++e) size = std::max(size, std::abs(hessian.valuePtr()[e]));
  if (!hessian.coeffs().allFinite() || size > SymmetricFactorisation::largest_entry) return std::nullopt;
  constexpr double most = 1e4;  // times the size: more than the norm of any sparse matrix of this kind
  constexpr double growth = 8.0;
  double too_small = 0.0;
  double enough = least_shift;
  while (!is_enough(enough)) {
    too_small = enough;
    enough *= growth;
    if (enough > most * size) return enough;
    if (is_stopped && is_stopped()) return std::nullopt;
  }
  constexpr double close = 1.1;
  while (too_small > 0.0 && enough > close * too_small) {
    if (is_stopped && is_stopped()) return std::nullopt;
    const double middle = std::sqrt(too_small * enough);
    (is_enough(middle) ? enough : too_small) = middle;
  }
  return enough;
}

Eigen::MatrixXd LimitedMemoryHessian::times(const Eigen::Ref<const Eigen::MatrixXd>& vectors) const {
  Eigen::MatrixXd result = diagonal_.asDiagonal() * vectors;
  for (const Update& update : updates_) {
    result += update.added * (update.added.transpose() * vectors);
    result -= update.removed * (update.removed.transpose() * vectors);
  }
  return result;
}

void LimitedMemoryHessian::update(const Eigen::VectorXd& step, const Eigen::VectorXd& change) {
  Eigen::VectorXd curved = times(step);
  const double old_curvature = step.dot(curved);
  if (!(old_curvature > 0.0)) return;
  constexpr double least_share = 0.2;
  const double seen = step.dot(change);
  const double weight =
      seen >= least_share * old_curvature ? 1.0 : (1.0 - least_share) * old_curvature / (old_curvature - seen);
  const Eigen::VectorXd damped = weight * change + (1.0 - weight) * curved;
  if (updates_.size() == most_updates) {
    for (const Update& update : updates_) diagonal_ += update.added.cwiseAbs2() - update.removed.cwiseAbs2();
    updates_.clear();
    curved = diagonal_.cwiseProduct(step);  // the old curvature along the step belongs to the new start
  }
  updates_.push_back({damped / std::sqrt(step.dot(damped)), curved / std::sqrt(step.dot(curved))});
}

}  // namespace dmocbench::sqp
