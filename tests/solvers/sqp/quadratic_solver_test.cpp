#include "methods/solvers/sqp/quadratic/quadratic_solver.hpp"

#include <gtest/gtest.h>

#include "tests/solvers/sqp/random_quadratic_program.hpp"

namespace dmocbench::sqp {
namespace {

using tests::owned;
using tests::OwnedQuadraticProgram;
using tests::random_program;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double fine = 1e-7;

QuadraticSolution solve(const QuadraticProgram& program, Crash crash = Crash::none) {
  QuadraticSolver solver({.tolerance = 1e-10, .crash = crash}, Pricing(), [](const MinorIteration&) { return true; });
  return solver.solve(program);
}

/// The conditions of optimality, by dense linear algebra: they are sufficient as the programs are convex.
void expect_optimal(const OwnedQuadraticProgram& problem, const QuadraticSolution& solution) {
  const QuadraticProgram& program = problem.program;
  ASSERT_EQ(solution.status, QuadraticStatus::optimal) << solution.message;
  const Eigen::Index n = program.variable_count();
  const Eigen::MatrixXd dense_rows = Eigen::MatrixXd(program.columns).leftCols(n);
  const Eigen::VectorXd gradient =
      program.gradient + problem.dense_hessian * solution.step + dense_rows.transpose() * solution.multipliers;
  const Eigen::VectorXd rows = dense_rows * solution.step;
  for (Eigen::Index j = 0; j < n; ++j) {
    EXPECT_GE(solution.step[j], program.lower[j] - fine);
    EXPECT_LE(solution.step[j], program.upper[j] + fine);
    if (gradient[j] > fine) {
      EXPECT_NEAR(solution.step[j], program.lower[j], fine);
    }
    if (gradient[j] < -fine) {
      EXPECT_NEAR(solution.step[j], program.upper[j], fine);
    }
  }
  for (Eigen::Index i = 0; i < program.row_count(); ++i) {
    EXPECT_GE(rows[i], program.lower[n + i] - fine);
    EXPECT_LE(rows[i], program.upper[n + i] + fine);
    if (solution.multipliers[i] > fine) {
      EXPECT_NEAR(rows[i], program.upper[n + i], fine);
    }
    if (solution.multipliers[i] < -fine) {
      EXPECT_NEAR(rows[i], program.lower[n + i], fine);
    }
  }
}

TEST(QuadraticSolver, MinimisesUnderEqualitiesAndBounds) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const double box = seed % 2 == 0 ? 0.3 : 100.0;  // bounds that matter, and bounds that do not
    const auto problem = random_program(30, 12, box, seed);
    expect_optimal(problem, solve(problem.program));
    expect_optimal(problem, solve(problem.program, Crash::basis));
  }
}

TEST(QuadraticSolver, MinimisesUnderInequalityRows) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    auto problem = random_program(20, 15, 0.5, seed);
    // Half of the rows become one-sided or two-sided inequalities around the point that fulfils them all.
    for (Eigen::Index i = 20; i < 35; i += 2) {
      problem.program.lower[i] = i % 4 == 0 ? -infinity : problem.program.lower[i] - 0.1;
      problem.program.upper[i] += 0.2;
    }
    expect_optimal(problem, solve(problem.program));
  }
}

TEST(QuadraticSolver, SaysWhichRowsCannotBeMet) {
  // d <= 1 and d >= 3.
  const auto problem = owned(Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Ones(1, 1),
                             Eigen::Vector2d(-infinity, 3.0), Eigen::Vector2d(1.0, infinity));
  const QuadraticSolution solution = solve(problem.program);
  EXPECT_EQ(solution.status, QuadraticStatus::infeasible);
  EXPECT_DOUBLE_EQ(solution.infeasibility, 2.0);
  EXPECT_DOUBLE_EQ(solution.step[0], 1.0);
}

TEST(QuadraticSolver, FindsTheMinimumOfContradictoryRowsAmongPointsOfLeastViolation) {
  // d₁ = 0 and d₁ = 2 contradict each other; d₂ is free to follow the objective.
  Eigen::MatrixXd rows(2, 2);
  rows << 1.0, 0.0,  //
      1.0, 0.0;
  const auto problem =
      owned(Eigen::MatrixXd::Identity(2, 2), Eigen::Vector2d(0.0, -5.0), rows,
            Eigen::Vector4d(-infinity, -infinity, 0.0, 2.0), Eigen::Vector4d(infinity, infinity, 0.0, 2.0));
  const QuadraticSolution solution = solve(problem.program);
  EXPECT_EQ(solution.status, QuadraticStatus::infeasible);
  EXPECT_DOUBLE_EQ(solution.infeasibility, 2.0);
  EXPECT_DOUBLE_EQ(solution.step[1], 5.0);
}

TEST(QuadraticSolver, ToleratesRowsThatDependOnEachOther) {
  Eigen::MatrixXd rows(3, 4);
  rows << 1.0, 2.0, 0.0, 1.0,  //
      0.0, 1.0, 1.0, 0.0,      //
      1.0, 3.0, 1.0, 1.0;      // the sum of the other two
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(7, -infinity);
  lower.tail(3) << 1.0, 2.0, 3.0;
  Eigen::VectorXd upper = -lower;
  upper.tail(3) = lower.tail(3);
  const auto problem = owned(Eigen::MatrixXd::Identity(4, 4), Eigen::Vector4d(1.0, -1.0, 0.5, 0.0), rows, lower, upper);
  expect_optimal(problem, solve(problem.program));
  expect_optimal(problem, solve(problem.program, Crash::basis));
}

TEST(QuadraticSolver, NeverTellsAnIndefiniteReducedHessianForAMinimum) {
  const auto problem = owned(Eigen::Vector2d(1.0, -1.0).asDiagonal(), Eigen::Vector2d(1.0, 1.0),
                             Eigen::MatrixXd(Eigen::RowVector2d(1.0, 0.0)), Eigen::Vector3d::Constant(-infinity),
                             Eigen::Vector3d::Constant(infinity));
  EXPECT_EQ(solve(problem.program).status, QuadraticStatus::breakdown);
}

TEST(QuadraticSolver, FromTheSetsOfItsSolutionNeedsOneMinorIteration) {
  auto problem = random_program(30, 12, 100.0, 5);
  int minors = 0;
  QuadraticSolver solver({.tolerance = 1e-10, .crash = Crash::none}, Pricing(), [&](const MinorIteration&) {
    ++minors;
    return true;
  });
  expect_optimal(problem, solver.solve(problem.program));
  EXPECT_EQ(minors, 30);
  problem.program.gradient *= 1.1;
  problem.program.lower.tail(12) *= 0.9;
  problem.program.upper.tail(12) *= 0.9;
  minors = 0;
  expect_optimal(problem, solver.solve(problem.program));
  EXPECT_EQ(minors, 1);
}

TEST(QuadraticSolver, StopsWhenItsObserverSaysSo) {
  const auto problem = random_program(30, 12, 100.0, 5);
  int minors = 0;
  QuadraticSolver solver({}, Pricing(), [&](const MinorIteration&) { return ++minors < 7; });
  EXPECT_EQ(solver.solve(problem.program).status, QuadraticStatus::stopped);
  EXPECT_EQ(minors, 7);
}

}  // namespace
}  // namespace dmocbench::sqp
