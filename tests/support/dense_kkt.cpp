#include "tests/support/dense_kkt.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace dmocbench::tests {

namespace {

Eigen::VectorX<long double> joined(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers) {
  Eigen::VectorX<long double> x(primal.size() + multipliers.size());
  x << primal.cast<long double>(), multipliers.cast<long double>();
  return x;
}

}  // namespace

DenseKkt::DenseKkt(const NonlinearProgram& program, const KktNumbers& numbers)
    : n_(static_cast<Eigen::Index>(program.variable_count())),
      m_(static_cast<Eigen::Index>(program.constraint_count())),
      compliance_(numbers.compliance) {
  matrix_.setZero(n_ + m_, n_ + m_);
  const SparsityPattern hessian = program.hessian_structure().expand();
  for (std::size_t e = 0; e < hessian.size(); ++e) {
    matrix_(hessian.rows[e], hessian.columns[e]) = numbers.hessian[static_cast<Eigen::Index>(e)];
    matrix_(hessian.columns[e], hessian.rows[e]) = numbers.hessian[static_cast<Eigen::Index>(e)];
  }
  const SparsityPattern jacobian = program.jacobian_structure().expand();
  for (std::size_t e = 0; e < jacobian.size(); ++e) {
    matrix_(n_ + jacobian.rows[e], jacobian.columns[e]) = numbers.jacobian[static_cast<Eigen::Index>(e)];
    matrix_(jacobian.columns[e], n_ + jacobian.rows[e]) = numbers.jacobian[static_cast<Eigen::Index>(e)];
  }
  matrix_.diagonal().head(n_) += numbers.diagonal;
  matrix_.diagonal().tail(m_) -= numbers.compliance;
  right_hand_side_.resize(n_ + m_);
  right_hand_side_ << -numbers.gradient, -numbers.rows;
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

DenseKkt::Inertia DenseKkt::inertia() const {
  std::vector<Eigen::Index> equalities;
  std::vector<Eigen::Index> inequalities;
  for (Eigen::Index i = 0; i < m_; ++i) (compliance_[i] > 0.0 ? inequalities : equalities).push_back(n_ + i);
  Inertia result;
  const auto unknowns = static_cast<Eigen::Index>(free_.size());
  const auto rows = static_cast<Eigen::Index>(equalities.size());
  if (rows > unknowns) {
    result.rank = 0.0;
    return result;
  }
  Eigen::MatrixXd form = matrix_(free_, free_);
  const Eigen::MatrixXd inequality_rows = matrix_(inequalities, free_);
  const Eigen::VectorXd weights = -matrix_.diagonal()(inequalities).cwiseInverse();
  form += inequality_rows.transpose() * weights.asDiagonal() * inequality_rows;
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(unknowns, unknowns);
  if (rows > 0) {
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(matrix_(free_, equalities));
    const Eigen::VectorXd pivots = factors.matrixQR().diagonal().cwiseAbs();
    result.rank = pivots.minCoeff() / pivots.maxCoeff();
    basis = factors.householderQ();
  }
  if (rows == unknowns) return result;
  const auto null_space = basis.rightCols(unknowns - rows);
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(null_space.transpose() * form * null_space, Eigen::EigenvaluesOnly)
          .eigenvalues();
  result.smallest = eigenvalues.minCoeff();
  result.largest = eigenvalues.cwiseAbs().maxCoeff();
  return result;
}

Eigen::VectorXd DenseKkt::solution() const {
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(matrix_);
  LongVector x = factors.solve(right_hand_side_).cast<long double>();
  constexpr int corrections = 4;
  for (int i = 0; i < corrections; ++i) x += factors.solve(residual(x).cast<double>()).cast<long double>();
  return x.cast<double>();
}

double DenseKkt::condition() const {
  const Eigen::VectorXd sizes =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix_, Eigen::EigenvaluesOnly).eigenvalues().cwiseAbs();
  return sizes.maxCoeff() / sizes.minCoeff();
}

void DenseKkt::residual_of(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers, Eigen::VectorXd& gradient,
                           Eigen::VectorXd& rows) const {
  const Eigen::VectorXd left = residual(joined(primal, multipliers)).cast<double>();
  gradient = -left.head(n_);
  rows = -left.tail(m_);
}

double DenseKkt::backward_error(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers) const {
  const LongVector x = joined(primal, multipliers);
  const long double size =
      static_cast<long double>(matrix_.cwiseAbs().rowwise().sum().maxCoeff()) * x.lpNorm<Eigen::Infinity>() +
      static_cast<long double>(right_hand_side_.lpNorm<Eigen::Infinity>());
  return static_cast<double>(residual(x).lpNorm<Eigen::Infinity>() / size);
}

DenseKkt::LongVector DenseKkt::residual(const LongVector& x) const {
  LongVector left = right_hand_side_.cast<long double>();
  for (Eigen::Index j = 0; j < matrix_.cols(); ++j) {
    for (Eigen::Index i = 0; i < matrix_.rows(); ++i) {
      if (matrix_(i, j) != 0.0) left[i] -= static_cast<long double>(matrix_(i, j)) * x[j];
    }
  }
  return left;
}

}  // namespace dmocbench::tests
