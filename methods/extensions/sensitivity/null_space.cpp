#include "methods/extensions/sensitivity/null_space.hpp"

#include <Eigen/QR>

namespace dmocbench {

namespace {

/// `count` columns of Q of QR = A, from column `first` on.
Eigen::MatrixXd columns_of_q(const Eigen::MatrixXd& a, Eigen::Index first, Eigen::Index count) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(a);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(a.rows(), count);
  columns.middleRows(first, count).setIdentity();
  columns.applyOnTheLeft(factors.householderQ());
  return columns;
}

}  // namespace

Eigen::MatrixXd null_space(const Eigen::MatrixXd& a) {
  return columns_of_q(a.transpose().colwise().normalized(), a.rows(), a.cols() - a.rows());
}

double pivot_ratio(const Eigen::MatrixXd& a) {
  const Eigen::VectorXd pivots = a.colPivHouseholderQr().matrixQR().diagonal().cwiseAbs();
  return pivots[0] > 0.0 ? pivots[pivots.size() - 1] / pivots[0] : 0.0;
}

Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& a) { return columns_of_q(a, 0, a.cols()); }

}  // namespace dmocbench
