#include "methods/judgement/confirm.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/small_programs.hpp"

namespace dmocbench {
namespace {

using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

/// min x² + y² with x + y = 2: optimum (1, 1), λ = -2.
SmallProgram circle() {
  return tests::equality_program([](const HyperVector& x) { return x[0] * x[0] + x[1] * x[1]; },
                                 [](const HyperVector& x) { return HyperVector{x[0] + x[1]}; }, 2, vector({2.0}));
}

Solution claimed(Status status, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers) {
  SmallProgram program = circle();
  Solution solution;
  solution.status = status;
  solution.primal = primal;
  solution.multipliers = multipliers;
  confirm(program, 1e-8, solution);
  return solution;
}

TEST(Confirm, LetsATrueOptimumPass) {
  const Solution solution = claimed(Status::solved, vector({1.0, 1.0}), vector({-2.0}));
  EXPECT_EQ(solution.status, Status::solved);
  EXPECT_EQ(solution.objective, 2.0);
  EXPECT_EQ(solution.kkt_residual, 0.0);
  EXPECT_EQ(solution.constraint_violation, 0.0);
}

TEST(Confirm, EstimatesNoMultipliersOnceTimeIsOver) {
  for (const Status status : {Status::time_limit, Status::interrupted}) {
    const Solution late = claimed(status, vector({1.0, 1.0}), Eigen::VectorXd());
    EXPECT_TRUE(late.multipliers.hasNaN());
    EXPECT_FALSE(late.multipliers_are_estimated);
    EXPECT_FALSE(late.kkt_residual.has_value());
    EXPECT_EQ(late.constraint_violation, 0.0);
  }
  const Solution failed = claimed(Status::step_failed, vector({1.0, 1.0}), Eigen::VectorXd());
  EXPECT_NEAR(failed.multipliers[0], -2.0, 1e-15);
  EXPECT_TRUE(failed.multipliers_are_estimated);
}

TEST(Confirm, TakesSolvedBackWhereThePointIsNotStationary) {
  EXPECT_EQ(claimed(Status::solved, vector({1.0 + 1e-6, 1.0 - 1e-6}), vector({-2.0})).status, Status::not_confirmed);
}

TEST(Confirm, TakesSolvedBackWhereTheMultiplierIsWrong) {
  EXPECT_EQ(claimed(Status::solved, vector({1.0, 1.0}), vector({2.0})).status, Status::not_confirmed);
}

TEST(Confirm, TakesSolvedBackWhereARowIsViolated) {
  const Solution solution = claimed(Status::solved, vector({1.001, 1.001}), vector({-2.002}));
  EXPECT_EQ(solution.status, Status::not_confirmed);
  EXPECT_NEAR(solution.constraint_violation.value_or(unbounded), 0.002, 1e-12);
}

TEST(Confirm, TakesSolvedBackWhereSomethingIsNotANumber) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(claimed(Status::solved, vector({nan, 1.0}), vector({-2.0})).status, Status::not_confirmed);
  EXPECT_EQ(claimed(Status::solved, vector({1.0, 1.0}), vector({nan})).status, Status::not_confirmed);
  EXPECT_EQ(claimed(Status::solved, vector({nan, 1.0}), Eigen::VectorXd()).status, Status::not_confirmed);
}

TEST(Confirm, TurnsAcceptableIntoSolvedOnlyByTheSameTest) {
  EXPECT_EQ(claimed(Status::acceptable, vector({1.0, 1.0}), vector({-2.0})).status, Status::solved);
  EXPECT_EQ(claimed(Status::acceptable, vector({1.0 + 1e-6, 1.0 - 1e-6}), vector({-2.0})).status, Status::acceptable);
}

TEST(Confirm, NeverImprovesAFailure) {
  for (const Status status :
       {Status::infeasible, Status::iteration_limit, Status::interrupted, Status::not_run, Status::step_failed}) {
    const Solution solution = claimed(status, vector({1.0, 1.0}), vector({-2.0}));
    EXPECT_EQ(solution.status, status);
    EXPECT_EQ(solution.kkt_residual, 0.0);
  }
}

TEST(Confirm, TakesAcceptableBackBeyondAHundredTimesTheTolerance) {
  EXPECT_EQ(claimed(Status::acceptable, vector({1.0 + 1e-4, 1.0 - 1e-4}), vector({-2.0})).status,
            Status::not_confirmed);
}

TEST(Confirm, JudgesAPointWithoutMultipliersByItsLeastSquaresMultipliers) {
  const Solution solution = claimed(Status::solved, vector({1.0, 1.0}), Eigen::VectorXd());
  EXPECT_EQ(solution.status, Status::solved);
  EXPECT_TRUE(solution.multipliers_are_estimated);
  ASSERT_EQ(solution.multipliers.size(), 1);
  EXPECT_NEAR(solution.multipliers[0], -2.0, 1e-15);
  EXPECT_NEAR(solution.kkt_residual.value_or(unbounded), 0.0, 1e-15);
}

TEST(Confirm, TakesSolvedBackWhereAPointWithoutMultipliersIsOnlyFeasible) {
  const Solution solution = claimed(Status::solved, vector({1.5, 0.5}), Eigen::VectorXd());
  EXPECT_EQ(solution.status, Status::not_confirmed);
  EXPECT_EQ(solution.constraint_violation, 0.0);
  EXPECT_NEAR(solution.kkt_residual.value_or(unbounded), 1.0, 1e-15);  // gradients 3 and 1, λ = -2
}

TEST(Confirm, DoesNotMarkMultipliersThatTheSolverGave) {
  EXPECT_FALSE(claimed(Status::solved, vector({1.0, 1.0}), vector({-2.0})).multipliers_are_estimated);
}

TEST(Confirm, TakesNoEmptyAnswerForSolved) {
  Solution solution;
  solution.status = Status::solved;
  SmallProgram program = circle();
  confirm(program, 1e-8, solution);
  EXPECT_NE(solution.status, Status::solved);
}

}  // namespace
}  // namespace dmocbench
