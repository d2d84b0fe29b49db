#pragma once

#include <random>

#include <Eigen/Dense>

#include "methods/solvers/sqp/quadratic/quadratic_program.hpp"

namespace dmocbench::sqp::tests {

/// A dense matrix of normally distributed numbers.
inline Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); });
}

/// A quadratic program together with its dense Hessian.
struct OwnedQuadraticProgram {
  Eigen::MatrixXd dense_hessian;
  QuadraticProgram program;
};

inline OwnedQuadraticProgram owned(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient,
                                   const Eigen::MatrixXd& rows, const Eigen::VectorXd& lower,
                                   const Eigen::VectorXd& upper) {
  return {.dense_hessian = hessian,
          .program = {.hessian_times = [hessian](const auto& vectors) { return hessian * vectors; },
                      .gradient = gradient,
                      .columns = with_slacks(rows.sparseView()),
                      .lower = lower,
                      .upper = upper}};
}

/// n variables, m equality rows that a random point fulfils, positive definite Hessian; every second variable is
/// bounded to [-`box`, `box`], which contains the point.
inline OwnedQuadraticProgram random_program(Eigen::Index n, Eigen::Index m, double box, unsigned seed) {
  std::mt19937 generator(seed);
  const Eigen::MatrixXd root = random_matrix(n, n, generator);
  const Eigen::MatrixXd rows = random_matrix(m, n, generator);
  std::uniform_real_distribution<double> inside(-0.9 * box, 0.9 * box);
  const Eigen::VectorXd point = Eigen::VectorXd::NullaryExpr(n, [&] { return inside(generator); });
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(n + m, -infinity);
  Eigen::VectorXd upper = Eigen::VectorXd::Constant(n + m, infinity);
  for (Eigen::Index j = 0; j < n; j += 2) {
    lower[j] = -box;
    upper[j] = box;
  }
  lower.tail(m) = upper.tail(m) = rows * point;
  return owned(root.transpose() * root + Eigen::MatrixXd::Identity(n, n), random_matrix(n, 1, generator), rows, lower,
               upper);
}

}  // namespace dmocbench::sqp::tests
