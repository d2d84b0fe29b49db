#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/kkt_system.hpp"
#include "methods/solvers/interior_point/matrix_product.hpp"

namespace dmocbench::interior_point {

/// What a step leaves of a Newton system,
///
///   slope + (H + diag(d)) δx + Jᵀ δλ   and   rows + J δx - diag(e) δλ,
///
/// with zero for fixed variables, whose equation is δx = 0.
class NewtonResidual {
 public:
  explicit NewtonResidual(const NonlinearProgram& program) : NewtonResidual(program, ProgramRuns(program)) {}
  NewtonResidual(const NonlinearProgram& program, const ProgramRuns& runs);

  void compute(const KktMatrix& matrix, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
               const Eigen::VectorXd& primal_step, const Eigen::VectorXd& multiplier_step);

  [[nodiscard]] const Eigen::VectorXd& slope() const noexcept { return slope_; }  ///< one entry per variable
  [[nodiscard]] const Eigen::VectorXd& rows() const noexcept { return rows_; }    ///< one entry per row

  /// How much larger what is left is than what it may be: `accuracy` times the largest entry of the right-hand side,
  /// the rounding of the sums that it is left of, and the rounding of the program's own rows and slopes (its
  /// `rounding_floor`, by which every solver stops); slopes and rows each by their own. Infinite if a number is not
  /// finite. Arguments as in `compute` before.
  [[nodiscard]] double excess(const KktMatrix& matrix, const Eigen::VectorXd& primal_step,
                              const Eigen::VectorXd& multiplier_step, double accuracy) const;

 private:
  MatrixProduct hessian_;
  MatrixProduct jacobian_;
  MatrixProduct transposed_jacobian_;
  double floor_;  // the program's rounding_floor()
  std::vector<Eigen::Index> fixed_;
  Eigen::VectorXd slope_;
  Eigen::VectorXd rows_;
  double largest_slope_ = 0.0;  // of the right-hand side
  double largest_row_ = 0.0;
};

}  // namespace dmocbench::interior_point
