#include "methods/solvers/sqp/quadratic/reduced_hessian.hpp"

#include <gtest/gtest.h>

#include "tests/solvers/sqp/random_quadratic_program.hpp"

namespace dmocbench::sqp {
namespace {

using tests::random_matrix;

Eigen::MatrixXd random_definite(Eigen::Index size, std::mt19937& generator) {
  const Eigen::MatrixXd root = random_matrix(size, size, generator);
  return root.transpose() * root + Eigen::MatrixXd::Identity(size, size);
}

void expect_inverse_of(const ReducedHessian& reduced, const Eigen::MatrixXd& dense, std::mt19937& generator) {
  ASSERT_EQ(reduced.size(), dense.rows());
  const Eigen::VectorXd r = random_matrix(dense.rows(), 1, generator);
  EXPECT_LT((dense * reduced.solve(r) - r).lpNorm<Eigen::Infinity>(), 1e-10);
}

TEST(ReducedHessian, BorderedColumnByColumnIsTheWhole) {
  std::mt19937 generator(1);
  const Eigen::MatrixXd dense = random_definite(12, generator);
  ReducedHessian reduced;
  for (Eigen::Index i = 0; i < 12; ++i) {
    ASSERT_TRUE(reduced.append(dense.col(i).head(i), dense(i, i)));
    expect_inverse_of(reduced, dense.topLeftCorner(i + 1, i + 1), generator);
  }
}

TEST(ReducedHessian, RefusesABorderOfNegativeCurvatureAndStaysAsItWas) {
  std::mt19937 generator(2);
  const Eigen::MatrixXd dense = random_definite(5, generator);
  ReducedHessian reduced;
  ASSERT_TRUE(reduced.assign(dense));
  EXPECT_FALSE(reduced.append(dense.col(2), dense(2, 2) - 1e-3));  // the same direction again, with less curvature
  expect_inverse_of(reduced, dense, generator);
  EXPECT_FALSE(ReducedHessian().assign(-dense));
}

TEST(ReducedHessian, WithoutAColumnIsThatOfTheOthers) {
  std::mt19937 generator(3);
  const Eigen::MatrixXd dense = random_definite(6, generator);
  ReducedHessian reduced;
  ASSERT_TRUE(reduced.assign(dense));
  ASSERT_TRUE(reduced.remove(2));
  const std::vector<Eigen::Index> kept{0, 1, 3, 4, 5};
  const Eigen::MatrixXd expected = dense(kept, kept);
  expect_inverse_of(reduced, expected, generator);
}

TEST(ReducedHessian, AfterAnExchangeIsTheHessianOnTheSubspace) {
  // weights · y = 0 is solved for y₂: y = T y', and M' = TᵀMT.
  std::mt19937 generator(4);
  const Eigen::MatrixXd dense = random_definite(5, generator);
  const Eigen::VectorXd weights = random_matrix(5, 1, generator);
  ReducedHessian reduced;
  ASSERT_TRUE(reduced.assign(dense));
  ASSERT_TRUE(reduced.exchange(2, weights));
  const std::vector<Eigen::Index> kept{0, 1, 3, 4};
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(5, 4);
  for (Eigen::Index i = 0; i < 4; ++i) {
    basis(kept[static_cast<std::size_t>(i)], i) = 1.0;
    basis(2, i) = -weights[kept[static_cast<std::size_t>(i)]] / weights[2];
  }
  expect_inverse_of(reduced, basis.transpose() * dense * basis, generator);
}

}  // namespace
}  // namespace dmocbench::sqp
