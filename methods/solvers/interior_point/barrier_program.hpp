#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/judgement/stop_rule.hpp"
#include "methods/kkt/matrix_product.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/barrier_bounds.hpp"
#include "methods/solvers/interior_point/filter_line_search.hpp"
#include "methods/solvers/interior_point/optimality_errors.hpp"

namespace dmocbench::interior_point {

/// The program's values at a point.
struct Evaluation : PointValues {
  Eigen::VectorXd constraints;  ///< residuals c: a(x) - value of an equality, a(x) - s of an inequality
};

/// The barrier problem of a program, (3) of Wächter and Biegler with slacks and bounds on both sides,
///
///   minimise φ_μ(x, s) = f(x) - μ Σ ln d(x, s)  such that  c(x, s) = 0,
///
/// d the distances from the bounds, with the derivatives at the last point where they were evaluated.
class BarrierProgram {
 public:
  explicit BarrierProgram(NonlinearProgram& program);
  /// Reads the values of the program's bounds again. Allocates nothing, like all that follows.
  void read_bounds();

  [[nodiscard]] const NonlinearProgram& program() const noexcept { return program_; }
  [[nodiscard]] const BarrierBounds& bounds() const noexcept { return bounds_; }
  [[nodiscard]] bool has_bounds() const noexcept { return bounds_.count() > 0; }
  /// The constraints that are not equalities, in the order of their slacks.
  [[nodiscard]] const std::vector<Eigen::Index>& inequalities() const noexcept { return inequalities_; }

  /// Sets `at` to `start` and slacks a(start), pushed away from each bound by the share `push` of its size, at most of
  /// the distance between both bounds; multipliers of bounds 1, λ = 0. Section 3.6.
  void set_interior(const Eigen::VectorXd& start, double push, Iterate& at);

  /// The values at x and s; false, with an infinite θ, if f or θ is not finite.
  [[nodiscard]] bool evaluate(const Primal& at, double mu, Evaluation& result);
  /// φ_μ, where the objective is known.
  [[nodiscard]] double barrier_function(const Primal& at, double mu, double objective) const;
  /// Gradient and Jacobian at x.
  void differentiate(const Eigen::VectorXd& x);
  /// Hessian of f + λᵀa.
  void evaluate_hessian(const Iterate& at);

  [[nodiscard]] const Eigen::VectorXd& gradient() const noexcept { return gradient_; }
  [[nodiscard]] const Eigen::VectorXd& jacobian() const noexcept { return jacobian_; }
  [[nodiscard]] const Eigen::VectorXd& hessian() const noexcept { return hessian_; }

  /// The gradient of f + λᵀc with respect to x and s, zero for fixed variables; false if a number is not finite, as one
  /// of the gradient or the Jacobian then is.
  [[nodiscard]] bool gradient_of_lagrangian(const Eigen::VectorXd& multipliers, Primal& result) const;

  /// The errors from the gradient of the Lagrangian, see above, and the values at an iterate.
  [[nodiscard]] OptimalityErrors optimality_errors(const Iterate& at, const Primal& gradient, const Evaluation& values);
  /// Whether an iterate, with the errors that the last `optimality_errors` returned for it, may be the answer.
  [[nodiscard]] bool meets(const StopRule& rule, const OptimalityErrors& errors, const Iterate& at,
                           const Primal& gradient, const Evaluation& values) const;

 private:
  NonlinearProgram& program_;
  std::vector<Eigen::Index> inequalities_;
  std::vector<Eigen::Index> fixed_;
  bool has_bounded_variables_;
  Primal lower_;  // of x: empty without bounded variables
  Primal upper_;
  BarrierBounds bounds_;
  Eigen::VectorXd equality_values_;  // 0 of inequalities; empty if all are zero
  Eigen::VectorXd values_;           // of the constraints at a start
  kkt::MatrixProduct transposed_jacobian_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd jacobian_;
  Eigen::VectorXd hessian_;
  Primal balanced_;  // a gradient with the multipliers of bounds
};

}  // namespace dmocbench::interior_point
