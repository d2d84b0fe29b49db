#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace dmocbench::sqp {

/// M = ZᵀHZ on the superbasic columns, and its Cholesky factor L, bordered when a column joins.
class ReducedHessian {
 public:
  /// M as given (symmetric, lower triangle read). False if it is not positive definite.
  [[nodiscard]] bool assign(Eigen::MatrixXd matrix);

  /// A column joins at the end: `border` = Zᵀ H z for the columns so far, `diagonal` = zᵀHz. False if M is no longer
  /// positive definite; it is then left as it was.
  [[nodiscard]] bool append(const Eigen::VectorXd& border, double diagonal);

  /// The column at `place` leaves. False if the remainder is not positive definite.
  [[nodiscard]] bool remove(Eigen::Index place);

  /// The column at `place` goes into the basis in exchange for a basic column, which stays where it is: the superbasic
  /// columns then satisfy weights · y_S = 0, and the one at `place` is eliminated. False as above.
  [[nodiscard]] bool exchange(Eigen::Index place, const Eigen::VectorXd& weights);

  [[nodiscard]] Eigen::Index size() const noexcept { return size_; }
  /// M⁻¹ r.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& r) const;

 private:
  void reserve(Eigen::Index capacity);

  // The leading size_ rows and columns are in use: columns join one by one.
  Eigen::Index size_ = 0;
  Eigen::MatrixXd matrix_;
  Eigen::MatrixXd factor_;
};

}  // namespace dmocbench::sqp
