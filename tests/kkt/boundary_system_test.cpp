#include "methods/kkt/intervals/boundary_system.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include "tests/support/random_points.hpp"

namespace dmocbench::kkt {
namespace {

using tests::RandomPoints;

Eigen::MatrixXd random_square(RandomPoints& random, Eigen::Index n) {
  return Eigen::MatrixXd::NullaryExpr(n, n, [&](auto, auto) { return random.number(); });
}

/// Q diag(eigenvalues) Qᵀ with random directions.
Eigen::MatrixXd with_eigenvalues(RandomPoints& random, const Eigen::VectorXd& eigenvalues) {
  const Eigen::MatrixXd q =
      Eigen::HouseholderQR<Eigen::MatrixXd>(random_square(random, eigenvalues.size())).householderQ();
  const Eigen::MatrixXd product = q * eigenvalues.asDiagonal() * q.transpose();
  return 0.5 * (product + product.transpose());
}

/// Eigenvalues between 0.1 and 1 in magnitude, with random signs.
Eigen::VectorXd random_eigenvalues(RandomPoints& random, Eigen::Index n) {
  return random.vector(n).unaryExpr([](double r) { return std::copysign(0.1 + 0.9 * std::abs(r), r); });
}

struct SmallAnswer {
  DenseInertia inertia;
  Eigen::VectorXd solution;
};

SmallAnswer answer_for(Eigen::MatrixXd matrix, const Eigen::VectorXd& right_hand_side) {
  matrix.triangularView<Eigen::StrictlyUpper>().setConstant(1e30);  // is not to be read
  SmallAnswer answer{.inertia = {}, .solution = right_hand_side};
  SymmetricWork work;
  answer.inertia = solve_symmetric(matrix, answer.solution, work);
  return answer;
}

TEST(SymmetricSolve, FindsTheSolutionAndTheInertiaOfRandomMatrices) {
  RandomPoints random;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Index n = 1 + i % 25;
    const Eigen::VectorXd eigenvalues = random_eigenvalues(random, n);
    const Eigen::MatrixXd matrix = with_eigenvalues(random, eigenvalues);
    const Eigen::VectorXd wanted = random.vector(n);
    const SmallAnswer answer = answer_for(matrix, matrix * wanted);
    EXPECT_FALSE(answer.inertia.is_singular);
    EXPECT_TRUE(answer.inertia.is_certain);
    EXPECT_EQ(answer.inertia.negative, (eigenvalues.array() < 0.0).count());
    EXPECT_LT((answer.solution - wanted).lpNorm<Eigen::Infinity>(), 1e-12) << "n = " << n;
  }
}

TEST(SymmetricSolve, IsNotDisturbedByUnitsOfRowsAndColumns) {
  RandomPoints random;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Index n = 2 + i % 12;
    const Eigen::VectorXd eigenvalues = random_eigenvalues(random, n);
    const Eigen::VectorXd units = random.vector(n, -6.0, 6.0).unaryExpr([](double e) { return std::pow(10.0, e); });
    const Eigen::MatrixXd well_scaled = with_eigenvalues(random, eigenvalues);
    const Eigen::MatrixXd matrix = units.asDiagonal() * well_scaled * units.asDiagonal();
    const Eigen::VectorXd wanted = random.vector(n);
    const Eigen::VectorXd right_hand_side = units.cwiseProduct(well_scaled * wanted);
    const SmallAnswer answer = answer_for(matrix, right_hand_side);
    EXPECT_FALSE(answer.inertia.is_singular);
    EXPECT_EQ(answer.inertia.negative, (eigenvalues.array() < 0.0).count());
    EXPECT_LT((units.cwiseProduct(answer.solution) - wanted).lpNorm<Eigen::Infinity>(), 1e-10) << "n = " << n;
  }
}

TEST(SymmetricSolve, CountsBothSignsOfABlockOfTwo) {
  Eigen::MatrixXd matrix(2, 2);
  matrix << 0.0, 3.0, 3.0, 0.0;
  const SmallAnswer answer = answer_for(matrix, Eigen::Vector2d(6.0, 3.0));
  EXPECT_EQ(answer.inertia.negative, 1);
  EXPECT_NEAR(answer.solution[0], 1.0, 1e-15);
  EXPECT_NEAR(answer.solution[1], 2.0, 1e-15);
}

TEST(SymmetricSolve, TellsAMatrixWithoutFullRank) {
  RandomPoints random;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Index n = 1 + i % 25;
    const Eigen::Index missing = 1 + static_cast<Eigen::Index>(random.number(0.0, 0.5) * static_cast<double>(n));
    Eigen::VectorXd eigenvalues = random_eigenvalues(random, n);
    eigenvalues.head(missing).setZero();
    const SmallAnswer answer = answer_for(with_eigenvalues(random, eigenvalues), random.vector(n));
    EXPECT_TRUE(answer.inertia.is_singular) << "n = " << n << ", rank " << n - missing;
    EXPECT_FALSE(answer.inertia.is_certain);
  }
}

TEST(SymmetricSolve, TellsRowsThatAreZeroOrTheSame) {
  Eigen::MatrixXd matrix(3, 3);
  matrix << 1.0, 2.0, 0.0, 2.0, -1.0, 0.0, 0.0, 0.0, 0.0;
  EXPECT_TRUE(answer_for(matrix, Eigen::Vector3d::Ones()).inertia.is_singular);
  matrix << 1.0, 2.0, 2.0, 2.0, -1.0, -1.0, 2.0, -1.0, -1.0;
  EXPECT_TRUE(answer_for(matrix, Eigen::Vector3d::Ones()).inertia.is_singular);
}

TEST(SymmetricSolve, RefusesWhatIsNotANumber) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(2, 2);
  EXPECT_TRUE(answer_for(matrix, Eigen::Vector2d(1.0, std::numeric_limits<double>::infinity())).inertia.is_singular);
  matrix(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(answer_for(matrix, Eigen::Vector2d::Ones()).inertia.is_singular);
}

TEST(SymmetricSolve, HasNothingToDoForAnEmptyMatrix) {
  const SmallAnswer answer = answer_for(Eigen::MatrixXd(0, 0), Eigen::VectorXd(0));
  EXPECT_FALSE(answer.inertia.is_singular);
  EXPECT_EQ(answer.inertia.negative, 0);
}

}  // namespace
}  // namespace dmocbench::kkt
