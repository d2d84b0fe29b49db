#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/kkt_system.hpp"

namespace dmocbench::tests {

/// The numbers that a `KktMatrix` refers to, and a right-hand side.
struct KktNumbers {
  Eigen::VectorXd hessian;
  Eigen::VectorXd jacobian;
  Eigen::VectorXd diagonal;
  Eigen::VectorXd softness;
  Eigen::VectorXd slope;
  Eigen::VectorXd rows;

  [[nodiscard]] interior_point::KktMatrix matrix() const { return {hessian, jacobian, diagonal, softness}; }
};

/// The KKT system of a program by dense linear algebra: the solution from an LU factorisation whose error is corrected
/// with residuals in long double, the inertia from the Hessian on the null space of the equalities.
class DenseKkt {
 public:
  DenseKkt(const NonlinearProgram& program, const KktNumbers& numbers)
      : n_(static_cast<Eigen::Index>(program.variable_count())),
        m_(static_cast<Eigen::Index>(program.constraint_count())),
        softness_(numbers.softness) {
    matrix_.setZero(n_ + m_, n_ + m_);
    const SparsityPattern& hessian = program.hessian_structure();
    for (std::size_t e = 0; e < hessian.size(); ++e) {
      matrix_(hessian.rows[e], hessian.columns[e]) = numbers.hessian[static_cast<Eigen::Index>(e)];
      matrix_(hessian.columns[e], hessian.rows[e]) = numbers.hessian[static_cast<Eigen::Index>(e)];
    }
    const SparsityPattern& jacobian = program.jacobian_structure();
    for (std::size_t e = 0; e < jacobian.size(); ++e) {
      matrix_(n_ + jacobian.rows[e], jacobian.columns[e]) = numbers.jacobian[static_cast<Eigen::Index>(e)];
      matrix_(jacobian.columns[e], n_ + jacobian.rows[e]) = numbers.jacobian[static_cast<Eigen::Index>(e)];
    }
    matrix_.diagonal().head(n_) += numbers.diagonal;
    matrix_.diagonal().tail(m_) -= numbers.softness;
    right_hand_side_.resize(n_ + m_);
    right_hand_side_ << -numbers.slope, -numbers.rows;
    for (Eigen::Index i = 0; i < n_; ++i) {
      if (program.variable_lower()[i] == program.variable_upper()[i]) {
        matrix_.row(i).setZero();
        matrix_.col(i).setZero();
        matrix_(i, i) = 1.0;
        right_hand_side_[i] = 0.0;
      } else {
        free_.push_back(i);
      }
    }
  }

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
  [[nodiscard]] Inertia inertia() const {
    std::vector<Eigen::Index> hard;
    std::vector<Eigen::Index> soft;
    for (Eigen::Index i = 0; i < m_; ++i) (softness_[i] > 0.0 ? soft : hard).push_back(n_ + i);
    Inertia result;
    const auto unknowns = static_cast<Eigen::Index>(free_.size());
    const auto rows = static_cast<Eigen::Index>(hard.size());
    if (rows > unknowns) {
      result.rank = 0.0;
      return result;
    }
    Eigen::MatrixXd form = matrix_(free_, free_);
    const Eigen::MatrixXd soft_rows = matrix_(soft, free_);
    const Eigen::VectorXd weights = -matrix_.diagonal()(soft).cwiseInverse();
    form += soft_rows.transpose() * weights.asDiagonal() * soft_rows;
    Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(unknowns, unknowns);
    if (rows > 0) {
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(matrix_(free_, hard));
      const Eigen::VectorXd pivots = factors.matrixQR().diagonal().cwiseAbs();
      result.rank = pivots.minCoeff() / pivots.maxCoeff();
      basis = factors.householderQ();
    }
    if (rows == unknowns) return result;
    const auto null_space = basis.rightCols(unknowns - rows);
    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                                            null_space.transpose() * form * null_space, Eigen::EigenvaluesOnly)
                                            .eigenvalues();
    result.smallest = eigenvalues.minCoeff();
    result.largest = eigenvalues.cwiseAbs().maxCoeff();
    return result;
  }

  /// The solution, unknowns first.
  [[nodiscard]] Eigen::VectorXd solution() const {
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(matrix_);
    LongVector x = factors.solve(right_hand_side_).cast<long double>();
    constexpr int corrections = 4;
    for (int i = 0; i < corrections; ++i) x += factors.solve(residual(x).cast<double>()).cast<long double>();
    return x.cast<double>();
  }

  /// Of the matrix, in the Euclidean norm: the largest over the smallest magnitude of an eigenvalue.
  [[nodiscard]] double condition() const {
    const Eigen::VectorXd sizes =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix_, Eigen::EigenvaluesOnly).eigenvalues().cwiseAbs();
    return sizes.maxCoeff() / sizes.minCoeff();
  }

  /// The slope and the rows that the steps leave, so that a system with them has the correction as its solution.
  void residual_of(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers, Eigen::VectorXd& slope,
                   Eigen::VectorXd& rows) const {
    const Eigen::VectorXd left = residual(joined(primal, multipliers)).cast<double>();
    slope = -left.head(n_);
    rows = -left.tail(m_);
  }

  /// What the steps leave of the right-hand side, relative to the sizes of matrix, steps and right-hand side: the least
  /// relative change of the data that makes them exact.
  [[nodiscard]] double backward_error(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers) const {
    const LongVector x = joined(primal, multipliers);
    const long double size =
        static_cast<long double>(matrix_.cwiseAbs().rowwise().sum().maxCoeff()) * x.lpNorm<Eigen::Infinity>() +
        static_cast<long double>(right_hand_side_.lpNorm<Eigen::Infinity>());
    return static_cast<double>(residual(x).lpNorm<Eigen::Infinity>() / size);
  }

 private:
  using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

  [[nodiscard]] static LongVector joined(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers) {
    LongVector x(primal.size() + multipliers.size());
    x << primal.cast<long double>(), multipliers.cast<long double>();
    return x;
  }
  [[nodiscard]] LongVector residual(const LongVector& x) const {
    LongVector left = right_hand_side_.cast<long double>();
    for (Eigen::Index j = 0; j < matrix_.cols(); ++j) {
      for (Eigen::Index i = 0; i < matrix_.rows(); ++i) {
        if (matrix_(i, j) != 0.0) left[i] -= static_cast<long double>(matrix_(i, j)) * x[j];
      }
    }
    return left;
  }

  Eigen::Index n_;
  Eigen::Index m_;
  Eigen::VectorXd softness_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_hand_side_;
  std::vector<Eigen::Index> free_;
};

}  // namespace dmocbench::tests
