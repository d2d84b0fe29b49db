#include "methods/numerics/dense_solve.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/random_points.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

/// Hilbert's matrix shifted by ones on the diagonal: positive definite, condition below 3.
template <class Scalar>
Eigen::MatrixX<Scalar> shifted_hilbert_matrix(Eigen::Index size) {
  Eigen::MatrixX<Scalar> matrix = Eigen::MatrixX<Scalar>::Identity(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) matrix(i, j) += Scalar(1) / static_cast<Scalar>(i + j + 1);
  }
  return matrix;
}

template <class Scalar>
void expect_that_what_is_multiplied_comes_back() {
  tests::RandomPoints random;
  for (Eigen::Index size = 1; size <= 12; ++size) {
    Eigen::MatrixX<Scalar> a = shifted_hilbert_matrix<Scalar>(size);
    a.row(0).swap(a.row(size - 1));  // not symmetric, and rows have to be exchanged
    const Eigen::VectorX<Scalar> x = random.vector(size).template cast<Scalar>();
    Eigen::MatrixX<Scalar> both(size, 2);
    both << x, -x;
    const Eigen::VectorX<Scalar> product = a.lazyProduct(x);
    const Eigen::MatrixX<Scalar> products = a.lazyProduct(both);
    const Scalar rounding = 100 * std::numeric_limits<Scalar>::epsilon();
    EXPECT_LT((solve_square(a, product) - x).norm(), rounding);
    EXPECT_LT((solve_square(a, products) - both).norm(), rounding);
  }
}

TEST(DenseSolve, GivesBackWhatWasMultiplied) {
  expect_that_what_is_multiplied_comes_back<double>();
  expect_that_what_is_multiplied_comes_back<long double>();
}

TEST(DenseSolve, OfASingularMatrixIsNothing) {
  Eigen::MatrixXd a = shifted_hilbert_matrix<double>(4);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(4, -1.0, 2.0);
  ASSERT_TRUE(is_invertible(a));
  const Eigen::VectorXd solution = tests::value_of(solve_if_invertible(a, a * x));
  EXPECT_LT((solution - x).norm(), 1e-14);
  a.row(3) = a.row(1) - 2.0 * a.row(2);
  EXPECT_FALSE(is_invertible(a));
  EXPECT_FALSE(solve_if_invertible(a, x).has_value());
}

TEST(DenseSolve, OfAnIndefiniteMatrixIsNothingByCholesky) {
  Eigen::MatrixXd a = shifted_hilbert_matrix<double>(4);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(4, -1.0, 2.0);
  ASSERT_TRUE(is_positive_definite(a));
  const Eigen::VectorXd solution = tests::value_of(solve_if_positive_definite(a, a * x));
  EXPECT_LT((solution - x).norm(), 1e-14);
  a(2, 2) = -a(2, 2);
  EXPECT_TRUE(is_invertible(a));
  EXPECT_FALSE(is_positive_definite(a));
  EXPECT_FALSE(solve_if_positive_definite(a, x).has_value());
}

}  // namespace
}  // namespace dmocbench
