#include "methods/judgement/hidden_violation.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/judgement/confirm.hpp"
#include "tests/support/small_programs.hpp"

namespace dmocbench {
namespace {

using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

/// min ½ weight (x_0² + x_1²) with scale (x_0 + x_1) = scale 2: optimum (1, 1), λ = -weight / scale.
SmallProgram sum_of_two(double scale, double weight = 1.0) {
  SmallProgram::Statement statement;
  statement.objective = [weight](const HyperVector& x) { return 0.5 * weight * (x[0] * x[0] + x[1] * x[1]); };
  statement.rows = [scale](const HyperVector& x) { return HyperVector{scale * (x[0] + x[1])}; };
  statement.variable_lower = vector({-unbounded, -unbounded});
  statement.variable_upper = vector({unbounded, unbounded});
  statement.row_lower = vector({2.0 * scale});
  statement.row_upper = vector({2.0 * scale});
  return SmallProgram(statement);
}

std::optional<HiddenViolation> hidden_at(SmallProgram& program, const Eigen::VectorXd& point) {
  KktMemory memory;
  evaluate_kkt(program, point, vector({0.0}), memory);
  return ConstraintSizes().hidden_violation(program, point, memory);
}

TEST(HiddenViolation, IsTheSameShareInAllUnits) {
  for (int k = -300; k <= 300; k += 50) {
    SmallProgram program = sum_of_two(std::pow(10.0, k));
    const auto hidden = hidden_at(program, vector({0.5, 0.5}));  // 1 of 2 is missing; the size is 1
    ASSERT_TRUE(hidden) << k;
    EXPECT_NEAR(hidden->share, 1.0, 1e-12) << k;
    EXPECT_FALSE(hidden_at(program, vector({1.0, 1.0 - 1e-4}))) << k;
  }
}

TEST(HiddenViolation, OfUnknownsAtRestIsComparedWithOne) {
  SmallProgram program = sum_of_two(1.0);
  const auto hidden = hidden_at(program, vector({0.0, 0.0}));
  ASSERT_TRUE(hidden);
  EXPECT_NEAR(hidden->share, 1.0, 1e-12);  // 2 of 1 + 1
}

/// scale (36 - x_0²) >= 0.
SmallProgram limited_square(double scale) {
  SmallProgram::Statement statement;
  statement.objective = [](const HyperVector& x) { return 0.5 * x[0] * x[0]; };
  statement.rows = [scale](const HyperVector& x) { return HyperVector{scale * (36.0 - x[0] * x[0])}; };
  statement.variable_lower = vector({-unbounded});
  statement.variable_upper = vector({unbounded});
  statement.row_lower = vector({0.0});
  statement.row_upper = vector({unbounded});
  return SmallProgram(statement);
}

TEST(HiddenViolation, DoesNotTakeAnInequalityForTinyFarFromItsBound) {
  const auto is_small = [](double scale, double x) {
    SmallProgram program = limited_square(scale);
    KktMemory memory;
    evaluate_kkt(program, vector({x}), vector({0.0}), memory);
    ConstraintSizes sizes;
    EXPECT_FALSE(sizes.hidden_violation(program, vector({x}), memory));
    EXPECT_EQ(sizes.factors().size() > 0, sizes.has_small_inequality(program));
    return sizes.has_small_inequality(program);
  };
  EXPECT_FALSE(is_small(1.0, 1e-12));  // the derivative nearly vanishes, the distance is 36
  EXPECT_FALSE(is_small(1.0, 5.9));
  EXPECT_TRUE(is_small(1e-12, 1e-12));
  EXPECT_TRUE(is_small(1e-12, 5.9));
}

TEST(HiddenViolation, TakesSolvedBackWhereTheToleranceDoesNotSeeTheConstraint) {
  SmallProgram program = sum_of_two(1e-12);
  Solution solution;
  solution.status = Status::solved;
  solution.primal = vector({0.0, 0.0});  // the optimum without the constraint
  solution.multipliers = vector({0.0});
  confirm(program, 1e-8, solution);
  EXPECT_EQ(solution.status, Status::not_confirmed);
  solution.status = Status::solved;
  solution.primal = vector({1.0, 1.0});
  solution.multipliers = vector({-1e12});
  confirm(program, 1e-8, solution);
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
}

}  // namespace
}  // namespace dmocbench
