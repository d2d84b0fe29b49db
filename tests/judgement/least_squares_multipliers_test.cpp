#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "methods/judgement/kkt_residual.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/small_programs.hpp"

namespace dmocbench {
namespace {

using tests::box;
using tests::everywhere;
using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

TEST(LeastSquaresMultipliers, AreTheMultipliersAtTheKnownOptima) {
  // HS 7: λ = 1/(2√3). HS 39: ∇φ = (-1, 0, 0, 0) and rows (-3, 1, 0, 0), (2, -1, 0, 0) give λ = (-1, -1).
  // HS 40: by hand from the first three gradients.
  const auto known = tests::hock_schittkowski();
  SmallProgram seventh(known[1].statement);
  EXPECT_NEAR(least_squares_multipliers(seventh, known[1].optimum)[0], 0.5 / std::sqrt(3.0), 1e-14);
  SmallProgram thirty_ninth(known[2].statement);
  EXPECT_LT((least_squares_multipliers(thirty_ninth, known[2].optimum) - vector({-1.0, -1.0})).norm(), 1e-14);
  for (const tests::KnownProgram& one : known) {
    if (one.number == 71) continue;  // its optimum is known to nine digits only
    SmallProgram program(one.statement);
    const KktResidual residual = kkt_residual(program, one.optimum, least_squares_multipliers(program, one.optimum));
    EXPECT_LT(residual.stationarity, 1e-14) << "HS " << one.number;
  }
}

TEST(LeastSquaresMultipliers, LookAtFreeVariablesAwayFromTheirBoundsOnly) {
  // HS 71: x₁ = 1 is at its bound, where the gradient need not vanish.
  const tests::KnownProgram known = tests::hock_schittkowski().back();
  SmallProgram program(known.statement);
  const Eigen::VectorXd multipliers = least_squares_multipliers(program, known.optimum);
  EXPECT_NEAR(multipliers[0], -0.5522936596, 1e-7);
  EXPECT_NEAR(multipliers[1], 0.1614685642, 1e-7);
  // x₁ + x₂ = 3.5 at (2, 1.5): gradients -1 + λ at the bound of x₁, ½ + λ at x₂.
  SmallProgram held = box(3.5, 3.5);
  EXPECT_NEAR(least_squares_multipliers(held, vector({2.0, 1.5}))[0], -0.5, 1e-15);
}

TEST(LeastSquaresMultipliers, MinimiseTheGradientWhereThePointIsNotStationary) {
  // x₁ + x₂ = 2 at (1, 1): gradients -2 + λ and λ; the least of |(λ - 2, λ)| is at 1.
  SmallProgram program = box(2.0, 2.0);
  EXPECT_NEAR(least_squares_multipliers(program, vector({1.0, 1.0}))[0], 1.0, 1e-15);
}

TEST(LeastSquaresMultipliers, AreZeroForInequalitiesAwayFromTheirBounds) {
  SmallProgram inactive = box(-10.0, 10.0);
  EXPECT_EQ(least_squares_multipliers(inactive, vector({1.0, 1.0})), vector({0.0}));
  SmallProgram active = box(-10.0, 2.0);
  EXPECT_NEAR(least_squares_multipliers(active, vector({1.0, 1.0}))[0], 1.0, 1e-15);
}

TEST(LeastSquaresMultipliers, StandWhereRowsDependOnEachOther) {
  // The same row twice, and more rows than variables: λ₁ + λ₂ + λ₃ = -2 in any way.
  SmallProgram program = tests::equality_program([](const HyperVector& x) { return x[0] * x[0] + x[1] * x[1]; },
                                                 [](const HyperVector& x) {
                                                   return HyperVector{x[0] + x[1], x[0] + x[1], x[0] + x[1]};
                                                 },
                                                 2, everywhere(3, 2.0));
  const Eigen::VectorXd multipliers = least_squares_multipliers(program, vector({1.0, 1.0}));
  EXPECT_TRUE(multipliers.allFinite());
  EXPECT_NEAR(multipliers.sum(), -2.0, 1e-14);
}

TEST(LeastSquaresMultipliers, AreZeroWhereNoVariableIsFree) {
  SmallProgram program = box(4.0, 4.0);
  EXPECT_EQ(least_squares_multipliers(program, vector({2.0, 2.0})), vector({0.0}));
}

TEST(LeastSquaresMultipliers, AreNotNumbersWhereTheProgramIsNot) {
  SmallProgram program =
      tests::equality_program([](const HyperVector& x) { return log(x[0]); },
                              [](const HyperVector& x) { return HyperVector{sqrt(x[0])}; }, 1, vector({1.0}));
  EXPECT_TRUE(std::isnan(least_squares_multipliers(program, vector({-1.0}))[0]));
  EXPECT_TRUE(std::isnan(least_squares_multipliers(program, vector({std::numeric_limits<double>::quiet_NaN()}))[0]));
}

TEST(LeastSquaresMultipliers, RefuseAPointOfTheWrongSize) {
  SmallProgram program = box(2.0, 2.0);
  tests::expect_error_naming({"3", "2"},
                             [&] { static_cast<void>(least_squares_multipliers(program, everywhere(3, 0.0))); });
}

}  // namespace
}  // namespace dmocbench
