#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/kkt/kkt_system.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/transcription.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench::tests {

/// The numbers that a `KktMatrix` refers to, and a right-hand side.
struct KktNumbers {
  Eigen::VectorXd hessian;
  Eigen::VectorXd jacobian;
  Eigen::VectorXd diagonal;
  Eigen::VectorXd compliance;
  Eigen::VectorXd gradient;
  Eigen::VectorXd rows;

  [[nodiscard]] kkt::KktMatrix matrix() const { return {hessian, jacobian, diagonal, compliance}; }
};

/// The KKT system of a program by dense linear algebra: the solution from an LU factorisation whose error is corrected
/// with residuals in long double, the inertia from the Hessian on the null space of the equalities.
class DenseKkt {
 public:
  DenseKkt(const NonlinearProgram& program, const KktNumbers& numbers);

  /// What the inertia is read from.
  struct Inertia {
    /// Smallest pivot of the equalities' Jacobian relative to the largest, by QR with pivoting; 0 where there are more
    /// rows than unknowns, 1 where there are none.
    double rank = 1.0;
    /// Smallest and largest eigenvalue of the Hessian on the null space of the equalities, with inequalities as terms
    /// of it; 1 where that is the zero space.
    double smallest = 1.0;
    double largest = 1.0;
  };
  [[nodiscard]] Inertia inertia() const;

  /// The solution, unknowns first.
  [[nodiscard]] Eigen::VectorXd solution() const;

  /// Of the matrix, in the Euclidean norm: the largest over the smallest magnitude of an eigenvalue.
  [[nodiscard]] double condition() const;

  /// The gradient and the rows that the steps leave, so that a system with them has the correction as its solution.
  void residual_of(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers, Eigen::VectorXd& gradient,
                   Eigen::VectorXd& rows) const;

  /// What the steps leave of the right-hand side, relative to the sizes of matrix, steps and right-hand side: the least
  /// relative change of the data that makes them exact.
  [[nodiscard]] double backward_error(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers) const;

 private:
  using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

  [[nodiscard]] LongVector residual(const LongVector& x) const;

  Eigen::Index n_;
  Eigen::Index m_;
  Eigen::VectorXd compliance_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_hand_side_;
  std::vector<Eigen::Index> free_;
};

/// A system of a program near a start, with a Hessian that is shifted to be definite.
inline KktNumbers shifted_system(Transcription& program, const Eigen::VectorXd& start) {
  RandomPoints random;
  const auto m = static_cast<Eigen::Index>(program.constraint_count());
  KktNumbers numbers;
  numbers.hessian.resize(static_cast<Eigen::Index>(program.hessian_structure().size()));
  numbers.jacobian.resize(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  const Eigen::VectorXd x = start + random.vector(start.size(), -1e-2, 1e-2);
  program.hessian(x, 1.0, random.vector(m, -1e-2, 1e-2), numbers.hessian);
  program.jacobian(x, numbers.jacobian);
  numbers.diagonal = random.vector(start.size(), 10.0, 11.0);
  numbers.compliance = random.vector(m, 0.1, 1.0);
  for (Eigen::Index i = 0; i < m; ++i) {
    if (program.constraint_lower()[i] == program.constraint_upper()[i]) numbers.compliance[i] = 0.0;
  }
  numbers.gradient = random.vector(start.size());
  numbers.rows = random.vector(m);
  return numbers;
}

}  // namespace dmocbench::tests
