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
  Eigen::VectorXd gradient;              ///< empty where only values were asked for
  Eigen::SparseMatrix<double> jacobian;  ///< m x n

  [[nodiscard]] bool has_finite_values() const { return std::isfinite(objective) && constraints.allFinite(); }
};

/// Which variables may move: those whose bounds differ.
[[nodiscard]] std::vector<bool> free_variables(const NonlinearProgram& program);
/// Which rows are equalities.
[[nodiscard]] std::vector<bool> equality_rows(const NonlinearProgram& program);

/// Evaluates a program; counts and times what it does.
class Evaluator {
 public:
  explicit Evaluator(NonlinearProgram& program) : program_(program) {}

  [[nodiscard]] const NonlinearProgram& program() const noexcept { return program_; }
  [[nodiscard]] Linearisation values_at(const Eigen::VectorXd& point);
  /// Adds gradient and Jacobian.
  void differentiate(Linearisation& at);
  /// Lower triangle of the Hessian of φ + λᵀa.
  [[nodiscard]] Eigen::SparseMatrix<double> hessian_at(const Eigen::VectorXd& point,
                                                       const Eigen::VectorXd& multipliers);

  /// Largest amount by which a row leaves its bounds.
  [[nodiscard]] double violation(const Eigen::VectorXd& constraints) const;
  /// The same, row by row: positive above the upper bound, negative below the lower one.
  [[nodiscard]] Eigen::VectorXd violations(const Eigen::VectorXd& constraints) const;

  [[nodiscard]] int count() const noexcept { return count_; }
  [[nodiscard]] double seconds() const noexcept { return seconds_; }

 private:
  template <class Evaluation>
  void timed(const Evaluation& evaluation);

  NonlinearProgram& program_;
  int count_ = 0;
  double seconds_ = 0.0;
};

}  // namespace dmocbench
