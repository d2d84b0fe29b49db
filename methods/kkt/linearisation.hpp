#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// Values and first derivatives of a nonlinear program at a point.
struct Linearisation {
  Eigen::VectorXd point;
  double objective = 0.0;
  Eigen::VectorXd constraints;
  Eigen::VectorXd gradient;              ///< empty where only values were requested
  Eigen::SparseMatrix<double> jacobian;  ///< m x n

  [[nodiscard]] bool has_finite_values() const { return std::isfinite(objective) && constraints.allFinite(); }
};

/// True for the variables that may move: their bounds differ.
[[nodiscard]] std::vector<bool> free_variables(const NonlinearProgram& program);
/// The variables whose bounds are equal, in ascending order.
[[nodiscard]] std::vector<Eigen::Index> fixed_variables(const NonlinearProgram& program);
/// The constraints that are not equalities, in ascending order.
[[nodiscard]] std::vector<Eigen::Index> inequalities_of(const NonlinearProgram& program);
/// True for the constraints that are equalities.
[[nodiscard]] std::vector<bool> equalities_of(const NonlinearProgram& program);

/// Objective and constraints at a point.
[[nodiscard]] Linearisation values_at(NonlinearProgram& program, const Eigen::VectorXd& point);
/// Adds gradient and Jacobian.
void differentiate(NonlinearProgram& program, Linearisation& at);
/// Lower triangle of the Hessian of φ + λᵀa.
[[nodiscard]] Eigen::SparseMatrix<double> hessian_at(NonlinearProgram& program, const Eigen::VectorXd& point,
                                                     const Eigen::VectorXd& multipliers);

/// The amount by which each constraint leaves its bounds: positive above the upper one, negative below the lower one.
[[nodiscard]] Eigen::VectorXd violations(const NonlinearProgram& program, const Eigen::VectorXd& constraints);

/// Lower triangle of (H + δI, Eᵀ; E, 0), where E are the rows of the Jacobian that count. Fixed variables and the other
/// rows are replaced by unit rows (1 and -1), so that the pattern is the same at every point and the number of negative
/// eigenvalues that belongs to a positive definite H + δI on the null space of E equals the number of rows.
/// `hessian`: lower triangle, n x n; `jacobian`: m x n; `free`: n entries; `counts`: m entries.
[[nodiscard]] Eigen::SparseMatrix<double> kkt_matrix(const Eigen::SparseMatrix<double>& hessian, double shift,
                                                     const Eigen::SparseMatrix<double>& jacobian,
                                                     const std::vector<bool>& free, const std::vector<bool>& counts);

}  // namespace dmocbench
