#include "methods/solvers/sqp/quadratic/reduced_hessian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace dmocbench::sqp {

namespace {

/// A pivot of the Cholesky factorisation that is this small compared with its diagonal entry is rounding.
constexpr double smallest_relative_pivot = 100.0 * std::numeric_limits<double>::epsilon();

Eigen::MatrixXd without(const Eigen::MatrixXd& matrix, Eigen::Index place) {
  std::vector<Eigen::Index> kept(static_cast<std::size_t>(matrix.rows()));
  std::iota(kept.begin(), kept.end(), 0);
  kept.erase(kept.begin() + place);
  return matrix(kept, kept);
}

}  // namespace

bool ReducedHessian::assign(Eigen::MatrixXd matrix) {
  size_ = matrix.rows();
  matrix_ = std::move(matrix);
  if (size_ == 0) return true;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix_);
  if (cholesky.info() != Eigen::Success) return false;
  factor_ = cholesky.matrixL();
  return true;
}

void ReducedHessian::reserve(Eigen::Index capacity) {
  if (capacity <= matrix_.rows() && capacity <= factor_.rows()) return;
  const Eigen::Index rows = std::max<Eigen::Index>(2 * size_, capacity);
  matrix_.conservativeResize(rows, rows);
  factor_.conservativeResize(rows, rows);
}

bool ReducedHessian::append(const Eigen::VectorXd& border, double diagonal) {
  Eigen::VectorXd row = border;
  if (size_ > 0) factor_.topLeftCorner(size_, size_).triangularView<Eigen::Lower>().solveInPlace(row);
  const double pivot = diagonal - row.squaredNorm();
  if (!(pivot > smallest_relative_pivot * std::abs(diagonal))) return false;
  reserve(size_ + 1);
  matrix_.col(size_).head(size_) = border;
  matrix_.row(size_).head(size_) = border.transpose();
  matrix_(size_, size_) = diagonal;
  factor_.row(size_).head(size_) = row.transpose();
  factor_(size_, size_) = std::sqrt(pivot);
  ++size_;
  return true;
}

bool ReducedHessian::remove(Eigen::Index place) { return assign(without(matrix_.topLeftCorner(size_, size_), place)); }

bool ReducedHessian::exchange(Eigen::Index place, const Eigen::VectorXd& weights) {
  Eigen::MatrixXd changed = matrix_.topLeftCorner(size_, size_);
  const Eigen::VectorXd ratios = weights / weights[place];
  const Eigen::VectorXd old_column = changed.col(place);
  changed.noalias() -= old_column * ratios.transpose();
  changed.noalias() -= ratios * old_column.transpose();
  changed.noalias() += old_column[place] * ratios * ratios.transpose();
  return assign(without(changed, place));
}

Eigen::VectorXd ReducedHessian::solve(const Eigen::VectorXd& r) const {
  if (size_ == 0) return r;
  const auto lower = factor_.topLeftCorner(size_, size_).triangularView<Eigen::Lower>();
  Eigen::VectorXd result = lower.solve(r);
  lower.transpose().solveInPlace(result);
  return result;
}

}  // namespace dmocbench::sqp
