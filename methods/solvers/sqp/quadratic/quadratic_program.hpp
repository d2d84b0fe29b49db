#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace dmocbench::sqp {

/// The Hessian of a quadratic program, a symmetric matrix of which only products are needed.
class Hessian {
 public:
  virtual ~Hessian() = default;
  Hessian(const Hessian&) = delete;
  Hessian& operator=(const Hessian&) = delete;
  Hessian(Hessian&&) = delete;
  Hessian& operator=(Hessian&&) = delete;

  /// H D, for one vector or several side by side.
  [[nodiscard]] virtual Eigen::MatrixXd times(const Eigen::Ref<const Eigen::MatrixXd>& vectors) const = 0;

 protected:
  Hessian() = default;
};

/// The quadratic program of one major iteration, in n variables d with m rows,
///
///   minimise gᵀd + ½ dᵀHd  such that  A d - s = 0,  lower <= (d, s) <= upper,
///
/// where the slack s_i stands for the linearised constraint i; that of an equality is fixed. Bounds are those of the
/// nonlinear program shifted to the present point, so d = 0 lies within the bounds on d.
struct QuadraticProgram {
  const Hessian* hessian = nullptr;  ///< n x n, positive definite on the null space of the equality rows
  Eigen::VectorXd gradient;          ///< g, n entries
  Eigen::SparseMatrix<double> rows;  ///< A, m x n
  Eigen::VectorXd lower;             ///< n + m entries: of d, then of s
  Eigen::VectorXd upper;

  [[nodiscard]] Eigen::Index variable_count() const noexcept { return rows.cols(); }
  [[nodiscard]] Eigen::Index row_count() const noexcept { return rows.rows(); }
  /// n + m: the variables and the slacks.
  [[nodiscard]] Eigen::Index column_count() const noexcept { return rows.rows() + rows.cols(); }

  /// Column j of (A, -I).
  [[nodiscard]] Eigen::VectorXd column(Eigen::Index j) const {
    if (j < variable_count()) return rows.col(j);
    Eigen::VectorXd result = Eigen::VectorXd::Zero(row_count());
    result[j - variable_count()] = -1.0;
    return result;
  }

  /// (A, -I)ᵀ w: n + m entries.
  [[nodiscard]] Eigen::VectorXd transposed_times(const Eigen::VectorXd& w) const {
    Eigen::VectorXd result(column_count());
    result.head(variable_count()) = rows.transpose() * w;
    result.tail(row_count()) = -w;
    return result;
  }
};

}  // namespace dmocbench::sqp
