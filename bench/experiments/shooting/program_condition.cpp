#include "bench/experiments/shooting/program_condition.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <lapacke.h>

#include "methods/error.hpp"
#include "methods/kkt/linearisation.hpp"

namespace dmocbench {

namespace {

/// In ascending order; the lower triangle of the matrix is read.
Eigen::VectorXd eigenvalues(Eigen::MatrixXd symmetric) {
  const auto size = static_cast<lapack_int>(symmetric.rows());
  Eigen::VectorXd values(symmetric.rows());
  if (LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'N', 'L', size, symmetric.data(), size, values.data()) != 0) {
    throw Error("the eigenvalues of a symmetric matrix cannot be computed: an entry is not a number");
  }
  return values;
}

bool is_near(double value, double lower, double upper) {
  constexpr double at_bound = 1e-8;
  return std::min(value - lower, upper - value) < at_bound;
}

/// Throws `Error` if more holds than the equations.
void require_no_active_inequality(const NonlinearProgram& program, const Linearisation& at,
                                  const std::vector<bool>& free, const std::vector<bool>& equalities) {
  bool is_active = false;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    is_active |= free[i] && is_near(at.point[j], program.variable_lower()[j], program.variable_upper()[j]);
  }
  for (std::size_t i = 0; i < equalities.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    is_active |=
        !equalities[i] && is_near(at.constraints[j], program.constraint_lower()[j], program.constraint_upper()[j]);
  }
  if (is_active) throw Error("the condition of a program is defined for its equations only, but a bound is active");
}

/// Divides rows and columns of a symmetric matrix by the roots of their largest entries until all of these are 1.
void equilibrate(Eigen::MatrixXd& matrix) {
  constexpr int passes = 40;  // each brings the largest entries nearer to 1 by the square root
  for (int pass = 0; pass < passes; ++pass) {
    const Eigen::VectorXd scale = matrix.cwiseAbs().rowwise().maxCoeff().cwiseSqrt().cwiseInverse();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) matrix.col(j).array() *= scale.array() * scale[j];
  }
}

}  // namespace

std::optional<double> kkt_condition(NonlinearProgram& program, const Solution& solution) {
  Linearisation at = values_at(program, solution.primal);
  differentiate(program, at);
  const std::vector<bool> free = free_variables(program);
  const std::vector<bool> equalities = equalities_of(program);
  require_no_active_inequality(program, at, free, equalities);
  // Unit rows stand for the variables and rows left out: their eigenvalues are between the others.
  const Eigen::SparseMatrix<double> lower =
      kkt_matrix(hessian_at(program, solution.primal, solution.multipliers), 0.0, at.jacobian, free, equalities);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(lower.rows(), lower.cols());
  for (Eigen::Index j = 0; j < lower.cols(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, j); entry; ++entry) {
      matrix(entry.row(), j) = entry.value();
      matrix(j, entry.row()) = entry.value();
    }
  }
  equilibrate(matrix);
  if (!matrix.allFinite()) return std::nullopt;  // a row of zeros
  const Eigen::VectorXd magnitudes = eigenvalues(std::move(matrix)).cwiseAbs();
  const double condition = magnitudes.maxCoeff() / magnitudes.minCoeff();
  return std::isfinite(condition) ? std::optional(condition) : std::nullopt;
}

}  // namespace dmocbench
