#include "methods/kkt/symmetric_factorisation.hpp"

#include <algorithm>
#include <new>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <dlfcn.h>
#include <gtest/gtest.h>

#include "methods/kkt/linearisation.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "tests/solvers/sqp/random_quadratic_program.hpp"

namespace dmocbench {
namespace {

using sqp::tests::random_matrix;

Eigen::SparseMatrix<double> lower_of(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd triangle = matrix.triangularView<Eigen::Lower>();
  return triangle.sparseView();
}

TEST(SymmetricFactorisation, CountsNegativeEigenvaluesAndSolves) {
  std::mt19937 generator(11);
  SymmetricFactorisation factorisation;  // reused: the pattern changes with the size
  for (const Eigen::Index size : {1, 2, 5, 20, 21}) {
    const Eigen::MatrixXd root = random_matrix(size, size, generator);
    const Eigen::MatrixXd matrix = root + root.transpose();
    ASSERT_TRUE(factorisation.factorise(lower_of(matrix)));
    const Eigen::VectorXd eigenvalues = matrix.selfadjointView<Eigen::Lower>().eigenvalues();
    EXPECT_EQ(factorisation.negative_eigenvalues(), (eigenvalues.array() < 0.0).count());
    const Eigen::VectorXd right_hand_side = random_matrix(size, 1, generator);
    EXPECT_LT((matrix * factorisation.solve(right_hand_side) - right_hand_side).lpNorm<Eigen::Infinity>(), 1e-9);
  }
}

/// What MUMPS calls is the subroutine that the dynamic linker finds first.
TEST(SymmetricFactorisation, ThrowsWhereMumpsWouldEndTheProcess) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): dlsym knows no functions
  auto* const abort = reinterpret_cast<void (*)()>(dlsym(RTLD_DEFAULT, "mumps_abort_"));
  ASSERT_NE(abort, nullptr);
  EXPECT_THROW(abort(), std::bad_alloc);
}

/// As where pivots fail: a matrix that takes MUMPS long.
TEST(SymmetricFactorisation, EndsWithItsStopScopeAndWorksAgainAfterwards) {
  std::mt19937 generator(13);
  constexpr Eigen::Index size = 400;
  const Eigen::MatrixXd root = random_matrix(size, size, generator);
  const Eigen::SparseMatrix<double> lower = lower_of(root + root.transpose());
  SymmetricFactorisation factorisation;
  for (int i = 0; i < 3; ++i) {
    int asked = 0;
    const StopScope scope([&] { return ++asked > i; }, 0.0);
    EXPECT_THROW(static_cast<void>(factorisation.factorise(lower)), Stopped);
    EXPECT_EQ(asked, i + 1) << "it is asked within the factorisation";
  }
  ASSERT_TRUE(factorisation.factorise(lower));
  const Eigen::VectorXd right_hand_side = random_matrix(size, 1, generator);
  const Eigen::VectorXd product = lower.selfadjointView<Eigen::Lower>() * factorisation.solve(right_hand_side);
  EXPECT_LT((product - right_hand_side).lpNorm<Eigen::Infinity>(), 1e-8);
}

TEST(SymmetricFactorisation, FindsTheSameInAnyOrder) {
  std::mt19937 generator(12);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Index size = 1 + i % 7;
    const Eigen::MatrixXd root = random_matrix(size, size, generator);
    const Eigen::MatrixXd matrix = root + root.transpose();
    std::vector<int> positions(static_cast<std::size_t>(size));
    std::iota(positions.begin(), positions.end(), 0);
    std::ranges::shuffle(positions, generator);
    SymmetricFactorisation factorisation(positions);
    ASSERT_TRUE(factorisation.factorise(lower_of(matrix)));
    const Eigen::VectorXd eigenvalues = matrix.selfadjointView<Eigen::Lower>().eigenvalues();
    EXPECT_EQ(factorisation.negative_eigenvalues(), (eigenvalues.array() < 0.0).count());
    const Eigen::VectorXd right_hand_side = random_matrix(size, 1, generator);
    EXPECT_LT((matrix * factorisation.solve(right_hand_side) - right_hand_side).lpNorm<Eigen::Infinity>(), 1e-9);
  }
}

TEST(SymmetricFactorisation, SolvesWithAZeroDiagonal) {
  Eigen::MatrixXd matrix(3, 3);
  matrix << 0.0, 1.0, 0.0,  //
      1.0, 0.0, 2.0,        //
      0.0, 2.0, 1.0;
  SymmetricFactorisation factorisation;
  ASSERT_TRUE(factorisation.factorise(lower_of(matrix)));
  EXPECT_EQ(factorisation.negative_eigenvalues(), 1);
}

TEST(SymmetricFactorisation, TellsASingularMatrix) {
  SymmetricFactorisation factorisation;
  EXPECT_FALSE(factorisation.factorise(lower_of(Eigen::MatrixXd::Ones(3, 3))));
  EXPECT_TRUE(factorisation.factorise(lower_of(Eigen::MatrixXd::Identity(3, 3))));
}

TEST(SymmetricFactorisation, FactorisesARegularMatrixAfterASingularOneOfItsPattern) {
  // Rows of a collocation of x' = v, v' = u with a free horizon, without curvature: regular with a shift only.
  constexpr Eigen::Index intervals = 4;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2 * intervals, 3 * intervals - 1);
  for (Eigen::Index k = 0; k < intervals; ++k) {
    for (const Eigen::Index side : {0, 1}) {
      const Eigen::Index node = k - 1 + side;  // the ends are given
      if (node < 0 || node >= intervals - 1) continue;
      rows(k, node) = side == 0 ? -1.6 : 1.6;
      rows(k, intervals - 1 + node) = -0.5;
      rows(intervals + k, intervals - 1 + node) = side == 0 ? -3.2 : 3.2;
    }
    rows(intervals + k, 2 * (intervals - 1) + k) = -1.0;
    rows(k, 3 * intervals - 2) = -0.16;
  }
  const Eigen::SparseMatrix<double> jacobian = rows.sparseView();
  const Eigen::SparseMatrix<double> no_curvature(jacobian.cols(), jacobian.cols());
  const std::vector<bool> free(static_cast<std::size_t>(jacobian.cols()), true);
  const std::vector<bool> counts(static_cast<std::size_t>(jacobian.rows()), true);
  SymmetricFactorisation factorisation;
  EXPECT_FALSE(factorisation.factorise(kkt_matrix(no_curvature, 0.0, jacobian, free, counts)));
  for (const double shift : {1e-4, 1.0, 1e4}) {
    EXPECT_TRUE(factorisation.factorise(kkt_matrix(no_curvature, shift, jacobian, free, counts))) << shift;
    EXPECT_EQ(factorisation.negative_eigenvalues(), jacobian.rows());
  }
}

}  // namespace
}  // namespace dmocbench
