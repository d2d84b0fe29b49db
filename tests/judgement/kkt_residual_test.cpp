#include "methods/judgement/kkt_residual.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "tests/support/small_programs.hpp"

namespace dmocbench {
namespace {

using tests::box;
using tests::everywhere;
using tests::HyperDual;
using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

KktResidual at(SmallProgram program, const Eigen::VectorXd& x, double multiplier) {
  return kkt_residual(program, x, vector({multiplier}));
}

TEST(KktResidual, VanishesAtAnOptimumWhereABoundIsActive) {
  // Row inactive: x = (2, 1), the gradient -1 in x₁ pushes against its upper bound.
  const KktResidual residual = at(box(-10.0, 10.0), vector({2.0, 1.0}), 0.0);
  EXPECT_EQ(residual.stationarity, 0.0);
  EXPECT_EQ(residual.constraint_violation, 0.0);
}

TEST(KktResidual, VanishesAtAnOptimumWhereAnInequalityIsActive) {
  // x₁ + x₂ <= 2: x = (2, 0), gradients -1 + λ and -1 + λ with λ = 1; both bounds are met with gradient 0.
  EXPECT_EQ(at(box(-10.0, 2.0), vector({2.0, 0.0}), 1.0).stationarity, 0.0);
  // x₁ + x₂ >= 3.5: x = (2, 1.5), gradient of x₂ is ½ + λ, λ = -½.
  EXPECT_EQ(at(box(3.5, 10.0), vector({2.0, 1.5}), -0.5).stationarity, 0.0);
}

TEST(KktResidual, VanishesAtAnEqualityWhateverTheSignOfItsMultiplier) {
  EXPECT_EQ(at(box(3.5, 3.5), vector({2.0, 1.5}), -0.5).stationarity, 0.0);
  EXPECT_EQ(at(box(1.0, 1.0), vector({1.0, 0.0}), 2.0).stationarity, 0.0);    // gradients 0 and 1
  EXPECT_EQ(at(box(1.0, 1.0), vector({1.0, 0.0}), 1.25).stationarity, 0.75);  // gradient of x₁: -2 + 1.25
}

TEST(KktResidual, IsTheDerivativeInAFreeDirection) {
  EXPECT_DOUBLE_EQ(at(box(-10.0, 10.0), vector({2.0, 1.25}), 0.0).stationarity, 0.25);
}

TEST(KktResidual, CountsAGradientThatPullsAwayFromItsBound) {
  // At x₁ = 0 the gradient -3 wants x₁ to grow, and the bound on that side is far.
  EXPECT_DOUBLE_EQ(at(box(-10.0, 10.0), vector({0.0, 1.0}), 0.0).stationarity, 3.0);
}

TEST(KktResidual, CountsAMultiplierOfTheWrongSign) {
  // Same gradients as at the optimum of x₁ + x₂ <= 2, but the row is told to hold from below: λ = 1 pulls the wrong
  // way.
  EXPECT_DOUBLE_EQ(at(box(2.0, 10.0), vector({2.0, 0.0}), 1.0).stationarity, 1.0);
}

TEST(KktResidual, CountsTheMultiplierOfAnInactiveRow) {
  // (2, 1) with λ = ¼ at a row far from both its sides: x₂ has gradient ¼, the row is 7 away from its bound.
  EXPECT_DOUBLE_EQ(at(box(-10.0, 10.0), vector({2.0, 0.75}), 0.25).stationarity, 0.25);
}

TEST(KktResidual, DoesNotLookAtTheGradientOfFixedVariables) {
  SmallProgram program({[](const HyperVector& x) { return 5.0 * x[0] + x[1] * x[1]; },
                        [](const HyperVector&) { return HyperVector(); }, vector({1.0, -unbounded}),
                        vector({1.0, unbounded}), Eigen::VectorXd(0), Eigen::VectorXd(0)});
  EXPECT_EQ(kkt_residual(program, vector({1.0, 0.0}), Eigen::VectorXd(0)).stationarity, 0.0);
}

TEST(KktResidual, DoesNotLoseASmallGradientAtALargeVariable) {
  // x - (x - gradient) would be 0 here.
  SmallProgram program =
      tests::equality_program([](const HyperVector& x) { return 1e-9 * x[0]; },
                              [](const HyperVector&) { return HyperVector(); }, 1, Eigen::VectorXd(0));
  EXPECT_DOUBLE_EQ(kkt_residual(program, vector({1e9}), Eigen::VectorXd(0)).stationarity, 1e-9);
}

TEST(KktResidual, MeasuresHowFarRowsAndVariablesLeaveTheirBounds) {
  EXPECT_DOUBLE_EQ(at(box(-10.0, 1.0), vector({1.0, 0.75}), 0.0).constraint_violation, 0.75);
  EXPECT_DOUBLE_EQ(at(box(2.0, 10.0), vector({1.0, 0.75}), 0.0).constraint_violation, 0.25);
  EXPECT_DOUBLE_EQ(at(box(-10.0, 10.0), vector({-0.5, 1.0}), 0.0).constraint_violation, 0.5);
  EXPECT_DOUBLE_EQ(at(box(-10.0, 10.0), vector({1.0, 2.125}), 0.0).constraint_violation, 0.125);
}

TEST(KktResidual, ConstraintViolationAloneIsTheSame) {
  SmallProgram program = box(2.0, 10.0);
  EXPECT_DOUBLE_EQ(constraint_violation(program, vector({1.0, 0.75})), 0.25);
}

TEST(KktResidual, NeverHidesANaN) {
  // Wherever it stands, before or after larger numbers.
  for (const Eigen::VectorXd& x : {vector({nan, 1.0}), vector({2.0, nan}), vector({nan, 9.0})}) {
    const KktResidual residual = at(box(-10.0, 10.0), x, 0.0);
    EXPECT_TRUE(std::isnan(residual.stationarity));
    EXPECT_TRUE(std::isnan(residual.constraint_violation));
  }
  EXPECT_TRUE(std::isnan(at(box(-10.0, 10.0), vector({2.0, 1.0}), nan).stationarity));
  EXPECT_TRUE(std::isnan(at(box(3.0, 3.0), vector({2.0, 1.0}), nan).stationarity));
}

TEST(KktResidual, OfARowThatIsNotANumberIsNotANumber) {
  for (const bool first : {true, false}) {
    SmallProgram program = tests::equality_program([](const HyperVector& x) { return x[0]; },
                                                   [first](const HyperVector& x) {
                                                     const HyperDual bad = sqrt(-1.0 - x[0] * x[0]);
                                                     return first ? HyperVector{bad, x[0]} : HyperVector{x[0], bad};
                                                   },
                                                   1, vector({5.0, 5.0}));
    EXPECT_TRUE(std::isnan(constraint_violation(program, vector({0.0}))));
  }
}

TEST(KktResidual, RefusesVectorsOfTheWrongSize) {
  SmallProgram program = box(0.0, 1.0);
  EXPECT_THROW(static_cast<void>(kkt_residual(program, vector({1.0}), vector({0.0}))), Error);
  EXPECT_THROW(static_cast<void>(kkt_residual(program, vector({1.0, 1.0}), Eigen::VectorXd())), Error);
  EXPECT_THROW(static_cast<void>(constraint_violation(program, everywhere(3, 0.0))), Error);
}

TEST(FreeVariableCount, LeavesOutFixedVariables) {
  SmallProgram program({[](const HyperVector& x) { return x[0]; }, [](const HyperVector&) { return HyperVector(); },
                        vector({1.0, 0.0, -unbounded}), vector({1.0, 1.0, unbounded}), Eigen::VectorXd(0),
                        Eigen::VectorXd(0)});
  EXPECT_EQ(free_variable_count(program), 2U);
}

}  // namespace
}  // namespace dmocbench
