#include "methods/solvers/sqp/hessians.hpp"

#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/solvers/sqp/random_quadratic_program.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench::sqp {
namespace {

using tests::random_matrix;

/// Smallest eigenvalue on the null space of `rows`, from an orthonormal basis of it.
double smallest_reduced_eigenvalue(const Eigen::MatrixXd& hessian, const Eigen::MatrixXd& rows) {
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(rows);
  const Eigen::MatrixXd kernel = factors.kernel();
  const Eigen::MatrixXd basis = Eigen::HouseholderQR<Eigen::MatrixXd>(kernel).householderQ() *
                                Eigen::MatrixXd::Identity(kernel.rows(), kernel.cols());
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(basis.transpose() * hessian * basis).eigenvalues()[0];
}

TEST(Convexification, ShiftsByLittleMoreThanTheMostNegativeReducedCurvature) {
  std::mt19937 generator(21);
  Convexification convexification;
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::MatrixXd root = random_matrix(12, 12, generator);
    const Eigen::MatrixXd hessian = root + root.transpose();
    const Eigen::MatrixXd rows = random_matrix(5, 12, generator);
    const double shift = dmocbench::tests::value_of(
        convexification.shift_for(Eigen::MatrixXd(hessian.triangularView<Eigen::Lower>()).sparseView(),
                                  rows.sparseView(), std::vector<bool>(12, true), std::vector<bool>(5, true)));
    const double needed = std::max(0.0, -smallest_reduced_eigenvalue(hessian, rows));
    EXPECT_GE(shift, needed);
    EXPECT_LE(shift, 1.1 * needed);
  }
}

TEST(Convexification, LeavesAHessianAloneThatIsNegativeOnlyAcrossTheRows) {
  const Eigen::Matrix2d hessian = Eigen::Vector2d(-5.0, 1.0).asDiagonal();
  const Eigen::MatrixXd rows = Eigen::RowVector2d(1.0, 0.0);  // holds the first variable
  Convexification convexification;
  EXPECT_EQ(convexification.shift_for(hessian.sparseView(), rows.sparseView(), {true, true}, {true}), 0.0);
  EXPECT_GT(dmocbench::tests::value_of(
                convexification.shift_for(hessian.sparseView(), rows.sparseView(), {true, true}, {false})),
            5.0);
  EXPECT_EQ(convexification.shift_for(hessian.sparseView(), rows.sparseView(), {false, true}, {false}), 0.0);
}

/// Once the search for a shift had no end from 1.8e304 on, and MUMPS aborted at infinity.
TEST(Convexification, GivesUpWhereTheHessianIsNotFiniteOrTooLarge) {
  for (const double entry : {1e150, 1e305, std::numeric_limits<double>::infinity(), std::nan("")}) {
    const Eigen::Matrix2d hessian = Eigen::Vector2d(-entry, 1.0).asDiagonal();
    const Eigen::MatrixXd rows = Eigen::RowVector2d(0.0, 1.0);
    Convexification convexification;
    EXPECT_FALSE(convexification.shift_for(hessian.sparseView(), rows.sparseView(), {true, true}, {true})) << entry;
  }
}

TEST(Convexification, StopsWhenAsked) {
  const Eigen::Matrix2d hessian = Eigen::Vector2d(-1e90, 1.0).asDiagonal();
  const Eigen::MatrixXd rows = Eigen::RowVector2d(0.0, 1.0);
  Convexification convexification;
  int asked = 0;
  const auto is_stopped = [&] { return ++asked == 3; };
  EXPECT_FALSE(convexification.shift_for(hessian.sparseView(), rows.sparseView(), {true, true}, {true}, is_stopped));
  EXPECT_EQ(asked, 3);
}

Eigen::MatrixXd dense(const LimitedMemoryHessian& hessian, Eigen::Index size) {
  return hessian.times(Eigen::MatrixXd::Identity(size, size));
}

TEST(LimitedMemoryHessian, FulfilsTheSecantEquationAndStaysPositiveDefinite) {
  std::mt19937 generator(31);
  const Eigen::MatrixXd root = random_matrix(6, 6, generator);
  const Eigen::MatrixXd exact = root.transpose() * root + Eigen::MatrixXd::Identity(6, 6);
  LimitedMemoryHessian approximation(6);
  for (int update = 0; update < 35; ++update) {
    const Eigen::VectorXd step = random_matrix(6, 1, generator);
    const Eigen::VectorXd change = exact * step;
    const bool damped = step.dot(change) < 0.2 * step.dot(approximation.times(step).col(0));
    approximation.update(step, change);
    if (!damped) {
      EXPECT_LT((approximation.times(step) - change).norm(), 1e-8 * change.norm()) << update;
    }
    const Eigen::VectorXd eigenvalues = dense(approximation, 6).selfadjointView<Eigen::Lower>().eigenvalues();
    EXPECT_GT(eigenvalues.minCoeff(), 0.0) << update;
  }
}

TEST(LimitedMemoryHessian, StaysPositiveDefiniteAlongNegativeCurvature) {
  std::mt19937 generator(32);
  LimitedMemoryHessian approximation(4);
  for (int update = 0; update < 25; ++update) {
    const Eigen::VectorXd step = random_matrix(4, 1, generator);
    approximation.update(step, -step);
    EXPECT_GT(dense(approximation, 4).selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0.0) << update;
  }
}

}  // namespace
}  // namespace dmocbench::sqp
