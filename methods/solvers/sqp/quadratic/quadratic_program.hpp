#pragma once

#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "methods/solvers/linearisation.hpp"

namespace dmocbench::sqp {

/// H D for one vector or several side by side: the method needs no more of a Hessian than such products.
using HessianProduct = std::function<Eigen::MatrixXd(const Eigen::Ref<const Eigen::MatrixXd>&)>;

/// The quadratic program of one major iteration, in n variables d with m rows,
///
///   minimise gᵀd + ½ dᵀHd  such that  A d - s = 0,  lower <= (d, s) <= upper,
///
/// where the slack s_i stands for the linearised constraint i; that of an equality is fixed. Bounds are those of the
/// nonlinear program shifted to the present point, so d = 0 lies within the bounds on d.
struct QuadraticProgram {
  HessianProduct hessian_times;      ///< H is positive definite on the null space of the equality rows
  Eigen::VectorXd gradient;          ///< g, n entries
  Eigen::SparseMatrix<double> rows;  ///< A, m x n
  Eigen::VectorXd lower;             ///< n + m entries: of d, then of s
  Eigen::VectorXd upper;

  [[nodiscard]] Eigen::Index variable_count() const noexcept { return rows.cols(); }
  [[nodiscard]] Eigen::Index row_count() const noexcept { return rows.rows(); }
  /// n + m: the variables and the slacks.
  [[nodiscard]] Eigen::Index column_count() const noexcept { return rows.rows() + rows.cols(); }

  /// The columns of all slacks, in the order of their rows.
  [[nodiscard]] std::vector<Eigen::Index> slacks() const {
    std::vector<Eigen::Index> columns(static_cast<std::size_t>(row_count()));
    std::iota(columns.begin(), columns.end(), variable_count());
    return columns;
  }

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

/// The quadratic program at a point with derivatives.
[[nodiscard]] inline QuadraticProgram quadratic_program_at(const NonlinearProgram& program, const Linearisation& at,
                                                           HessianProduct hessian_times) {
  QuadraticProgram result{.hessian_times = std::move(hessian_times),
                          .gradient = at.gradient,
                          .rows = at.jacobian,
                          .lower = Eigen::VectorXd(at.point.size() + at.constraints.size()),
                          .upper = Eigen::VectorXd(at.point.size() + at.constraints.size())};
  result.lower << program.variable_lower() - at.point, program.constraint_lower() - at.constraints;
  result.upper << program.variable_upper() - at.point, program.constraint_upper() - at.constraints;
  return result;
}

}  // namespace dmocbench::sqp
