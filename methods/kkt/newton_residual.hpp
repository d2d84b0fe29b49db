#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/kkt/kkt_system.hpp"
#include "methods/kkt/matrix_product.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::kkt {

/// The residual of a Newton system,
///
///   gradient + (H + diag(d)) δx + Jᵀ δλ   and   constraints + J δx - diag(e) δλ,
///
/// with zero for fixed variables, whose equation is δx = 0.
class NewtonResidual {
 public:
  explicit NewtonResidual(const NonlinearProgram& program);

  void compute(const KktMatrix& matrix, const KktRightHandSide& right_hand_side, const KktStep& step);

  /// The residual that was computed last. As a right-hand side it gives the correction of the step.
  [[nodiscard]] KktRightHandSide value() const noexcept { return {.gradient = gradient_, .constraints = constraints_}; }

  /// The residual divided by its limit: the sum of `accuracy` times the largest entry of the right-hand side, the
  /// rounding of the sums that the residual is left of, and the largest of the program's `RoundingFloors`. Gradient and
  /// constraints have limits of their own; the larger ratio counts. Infinite if a number is not finite. `matrix` and
  /// `step` are the arguments of the last `compute`.
  [[nodiscard]] double excess(const KktMatrix& matrix, const KktStep& step, double accuracy) const;

 private:
  MatrixProduct diagonal_;
  MatrixProduct hessian_;
  MatrixProduct jacobian_;
  MatrixProduct transposed_jacobian_;
  const RoundingFloors& floors_;
  std::vector<Eigen::Index> fixed_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd constraints_;
  double largest_gradient_ = 0.0;  // of the right-hand side
  double largest_constraint_ = 0.0;
  bool is_finite_ = true;
};

}  // namespace dmocbench::kkt
