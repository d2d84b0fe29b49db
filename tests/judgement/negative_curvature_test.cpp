#include "methods/judgement/negative_curvature.hpp"

#include <gtest/gtest.h>

#include "methods/judgement/confirm.hpp"
#include "tests/support/small_programs.hpp"

namespace dmocbench {
namespace {

using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

/// φ = ½ Σ curvature_j x_j² with x_0 + x_1 = 0 and x_2 <= upper: in the null space (1, -1, 0)/√2 and (0, 0, 1).
SmallProgram bowl(const Eigen::Vector3d& curvatures, double upper = unbounded) {
  SmallProgram::Statement statement;
  statement.objective = [curvatures](const HyperVector& x) {
    return 0.5 * (curvatures[0] * x[0] * x[0] + curvatures[1] * x[1] * x[1] + curvatures[2] * x[2] * x[2]);
  };
  statement.rows = [](const HyperVector& x) { return HyperVector{x[0] + x[1]}; };
  statement.variable_lower = vector({-unbounded, -unbounded, -unbounded});
  statement.variable_upper = vector({unbounded, unbounded, upper});
  statement.row_lower = vector({0.0});
  statement.row_upper = vector({0.0});
  return SmallProgram(statement);
}

std::optional<NegativeCurvature> curvature_at(SmallProgram& program, const Eigen::VectorXd& point,
                                              const Eigen::VectorXd& multipliers) {
  return negative_curvature(program, LinearisedConditions(program, point, multipliers));
}

TEST(NegativeCurvature, IsTheMostNegativeEigenvalueInTheNullSpaceOfTheEqualities) {
  SmallProgram program = bowl({1.0, -3.0, -0.5});  // along the equality (1 - 3)/2 = -1
  const auto found = curvature_at(program, vector({0.0, 0.0, 0.0}), vector({0.0}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->share, -1.0 / 3.0, 1e-2 / 3.0);
  EXPECT_NEAR(found->direction[0], -found->direction[1], 1e-12);
  EXPECT_NEAR(std::abs(found->direction[0]), 1.0, 1e-12);
  EXPECT_LT(std::abs(found->direction[2]), 0.1);
}

TEST(NegativeCurvature, IsNotFoundWhereOnlyTheEqualitiesForbidIt) {
  SmallProgram program = bowl({4.0, -3.0, 0.5});  // along the equality 1/2
  EXPECT_FALSE(curvature_at(program, vector({0.0, 0.0, 0.0}), vector({0.0})));
}

TEST(NegativeCurvature, OfZeroOrRoundingIsNone) {
  for (const double curvature : {0.0, -1e-9}) {
    SmallProgram program = bowl({1.0, 1.0, curvature});
    EXPECT_FALSE(curvature_at(program, vector({0.0, 0.0, 0.0}), vector({0.0}))) << curvature;
  }
}

TEST(NegativeCurvature, IsTakenUpByABoundThatIsActiveAndByNoOther) {
  SmallProgram active = bowl({1.0, 1.0, -1.0}, 1.0);  // at x_2 = 1 the gradient is -1, its multiplier 1
  EXPECT_FALSE(curvature_at(active, vector({0.0, 0.0, 1.0}), vector({0.0})));
  SmallProgram far = bowl({1.0, 1.0, -1.0}, 1.0);
  EXPECT_TRUE(curvature_at(far, vector({0.0, 0.0, 0.0}), vector({0.0})));
}

TEST(NegativeCurvature, IsReportedOfASolvedPointAndForgottenAtTheNext) {
  SmallProgram program = bowl({1.0, -3.0, 1.0});
  Confirmation confirmation(program);
  Solution solution;
  solution.status = Status::solved;
  solution.primal = vector({0.0, 0.0, 0.0});
  solution.multipliers = vector({0.0});
  confirmation.judge(1e-8, solution);
  EXPECT_TRUE(solution.curvature);
  EXPECT_TRUE(confirmation.negative_curvature());
  solution.status = Status::iteration_limit;
  confirmation.judge(1e-8, solution);
  EXPECT_FALSE(solution.curvature);
  EXPECT_FALSE(confirmation.negative_curvature());
}

}  // namespace
}  // namespace dmocbench
