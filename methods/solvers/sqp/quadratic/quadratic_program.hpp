#pragma once

#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "methods/kkt/linearisation.hpp"

namespace dmocbench::sqp {

/// H D for one vector or several side by side: the method needs no more of a Hessian than such products.
using HessianProduct = std::function<Eigen::MatrixXd(const Eigen::Ref<const Eigen::MatrixXd>&)>;

/// The quadratic program of one major iteration, in n variables d with m rows,
///
///   minimise gᵀd + ½ dᵀHd  such that  A d - s = 0,  lower <= (d, s) <= upper,
///
/// where the slack s_i stands for the linearised constraint i; the slack of an equality is fixed. Bounds are the bounds
/// of the nonlinear program shifted to the present point, so d = 0 lies within the bounds on d.
struct QuadraticProgram {
  HessianProduct hessian_times;         ///< H is positive definite on the null space of the equality rows
  Eigen::VectorXd gradient;             ///< g, n entries
  Eigen::SparseMatrix<double> columns;  ///< (A, -I), m x (n + m)
  Eigen::VectorXd lower;                ///< n + m entries: of d, then of s
  Eigen::VectorXd upper;

  [[nodiscard]] Eigen::Index variable_count() const noexcept { return columns.cols() - columns.rows(); }
  [[nodiscard]] Eigen::Index row_count() const noexcept { return columns.rows(); }
  /// n + m: the variables and the slacks.
  [[nodiscard]] Eigen::Index column_count() const noexcept { return columns.cols(); }

  /// The columns of all slacks, in the order of their rows.
  [[nodiscard]] std::vector<Eigen::Index> slacks() const {
    std::vector<Eigen::Index> result(static_cast<std::size_t>(row_count()));
    std::iota(result.begin(), result.end(), variable_count());
    return result;
  }

  /// Column j of (A, -I).
  [[nodiscard]] Eigen::VectorXd column(Eigen::Index j) const { return columns.col(j); }
  /// (A, -I)ᵀ w: n + m entries.
  [[nodiscard]] Eigen::VectorXd transposed_times(const Eigen::VectorXd& w) const { return columns.transpose() * w; }
};

/// (A, -I).
[[nodiscard]] inline Eigen::SparseMatrix<double> with_slacks(const Eigen::SparseMatrix<double>& rows) {
  Eigen::SparseMatrix<double> identity(rows.rows(), rows.rows());
  identity.setIdentity();
  Eigen::SparseMatrix<double> result(rows.rows(), rows.cols() + rows.rows());
  result.leftCols(rows.cols()) = rows;
  result.rightCols(rows.rows()) = -identity;
  return result;
}

/// The quadratic program at a point with derivatives.
[[nodiscard]] inline QuadraticProgram quadratic_program_at(const NonlinearProgram& program, const Linearisation& at,
                                                           HessianProduct hessian_times) {
  QuadraticProgram result{.hessian_times = std::move(hessian_times),
                          .gradient = at.gradient,
                          .columns = with_slacks(at.jacobian),
                          .lower = Eigen::VectorXd(at.point.size() + at.constraints.size()),
                          .upper = Eigen::VectorXd(at.point.size() + at.constraints.size())};
  result.lower << program.variable_lower() - at.point, program.constraint_lower() - at.constraints;
  result.upper << program.variable_upper() - at.point, program.constraint_upper() - at.constraints;
  return result;
}

}  // namespace dmocbench::sqp
