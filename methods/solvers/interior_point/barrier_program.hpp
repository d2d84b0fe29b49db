#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/bound_list.hpp"
#include "methods/solvers/interior_point/matrix_product.hpp"

namespace dmocbench::interior_point {

/// A point of the barrier method. An inequality has a slack, a(x) = s. Unknowns and slacks have one multiplier z >= 0
/// per bound, in the order of their `BoundList`.
struct Point {
  Eigen::VectorXd x;
  Eigen::VectorXd s;            ///< one per inequality
  Eigen::VectorXd multipliers;  ///< λ, one per row
  Eigen::VectorXd x_lower;
  Eigen::VectorXd x_upper;
  Eigen::VectorXd s_lower;
  Eigen::VectorXd s_upper;
};

/// The program as the barrier method sees it,
///
///   minimise φ(x) - μ Σ ln(distances from bounds)  such that  a(x) = value or s,
///
/// (the value of an equality, the slack s of an inequality)
/// with the derivatives at the last point that they were asked for.
class BarrierProgram {
 public:
  static constexpr double usual_push = 1e-2;

  BarrierProgram(NonlinearProgram& program, const ProgramRuns& runs);

  [[nodiscard]] const NonlinearProgram& program() const noexcept { return program_; }
  [[nodiscard]] bool has_bounds() const noexcept { return bound_count_ > 0; }
  [[nodiscard]] Eigen::Index bound_count() const noexcept { return bound_count_; }
  [[nodiscard]] const BoundList& x_lower() const noexcept { return x_lower_; }
  [[nodiscard]] const BoundList& x_upper() const noexcept { return x_upper_; }
  [[nodiscard]] const BoundList& s_lower() const noexcept { return s_lower_; }
  [[nodiscard]] const BoundList& s_upper() const noexcept { return s_upper_; }
  /// The rows that are no equalities, in the order of their slacks.
  [[nodiscard]] const std::vector<Eigen::Index>& inequalities() const noexcept { return inequalities_; }
  /// The derivative of -λᵀs, one per slack.
  [[nodiscard]] Eigen::VectorXd slope_of_slacks(const Eigen::VectorXd& multipliers) const;

  /// `start` and slacks a(start) pushed into the interior, by `push` of their size or of the bounds' distance;
  /// multipliers of bounds 1, λ = 0.
  [[nodiscard]] Point interior(const Eigen::VectorXd& start, double push = usual_push);
  /// Multipliers of bounds that balance the slope of the Lagrangian where they can, at least those of the barrier.
  void balance_bounds(double mu, Point& point) const;

  /// What a point costs, and how far it is from the rows.
  struct Merit {
    double objective;  ///< φ
    double violation;  ///< Σ |residuals of the rows|
  };
  /// At x and s; `rows` becomes the residual, a(x) - value or a(x) - s. None if a number is not finite.
  [[nodiscard]] std::optional<Merit> evaluate(const Eigen::VectorXd& x, const Eigen::VectorXd& s,
                                              Eigen::VectorXd& rows);
  /// Gradient and Jacobian at x.
  void differentiate(const Eigen::VectorXd& x);
  /// Hessian of φ + λᵀa.
  void evaluate_hessian(const Point& point);

  [[nodiscard]] const Eigen::VectorXd& gradient() const noexcept { return gradient_; }
  [[nodiscard]] const Eigen::VectorXd& jacobian() const noexcept { return jacobian_; }
  [[nodiscard]] const Eigen::VectorXd& hessian() const noexcept { return hessian_; }

  /// result = ∇φ + Jᵀ multipliers; false if a number is not finite, as one of the gradient or the Jacobian then is.
  [[nodiscard]] bool slope_of_lagrangian(const Eigen::VectorXd& multipliers, Eigen::VectorXd& result) const;

  /// -Σ ln(distances), to be multiplied by μ.
  [[nodiscard]] double barrier(const Point& point) const;

  /// Largest |distance from a bound times its multiplier - μ|.
  [[nodiscard]] double complementarity(const Point& point, double mu) const;
  /// Keeps multipliers of bounds in the neighbourhood of the barrier's own.
  void keep_near_barrier(double mu, Point& point) const;

 private:
  NonlinearProgram& program_;
  BoundList x_lower_;
  BoundList x_upper_;
  BoundList s_lower_;
  BoundList s_upper_;
  Eigen::Index bound_count_ = 0;
  std::vector<Eigen::Index> inequalities_;
  Eigen::VectorXd values_;  // of equalities, 0 of inequalities; empty if all are zero
  MatrixProduct slope_of_rows_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd jacobian_;
  Eigen::VectorXd hessian_;
};

}  // namespace dmocbench::interior_point
