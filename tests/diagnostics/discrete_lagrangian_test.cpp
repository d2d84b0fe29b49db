#include "methods/diagnostics/discrete_lagrangian.hpp"

#include <gtest/gtest.h>

#include "methods/transcription/elements/tableau.hpp"
#include "tests/support/problems_for_tests.hpp"

namespace dmocbench {
namespace {

using tests::MovingFrame;

constexpr long double h = 0.3L;
constexpr long double t = 0.2L;
const LongVector q_0 = (LongVector(2) << 0.1L, -0.2L).finished();
const LongVector q_1 = (LongVector(2) << 0.25L, -0.05L).finished();

LongMatrix some_controls(int stages) {
  LongMatrix controls(stages, 2);
  for (Eigen::Index i = 0; i < stages; ++i) {
    controls.row(i) << 0.7L - 0.4L * static_cast<long double>(i), -0.3L + 0.5L * static_cast<long double>(i);
  }
  return controls;
}

class DiscreteLagrangianTest : public testing::TestWithParam<int> {
 protected:
  DiscreteLagrangian discrete{MovingFrame(), gauss_tableau(GetParam())};
  LongMatrix controls = some_controls(GetParam());

  /// Central differences of L_d, of order 6, so that in long double only rounding is left.
  [[nodiscard]] LongVector difference(bool of_left) const {
    constexpr long double step = 2e-3L;
    LongVector derivative(2);
    for (Eigen::Index i = 0; i < 2; ++i) {
      const auto at = [&](long double offset) {
        LongVector a = q_0;
        LongVector b = q_1;
        (of_left ? a : b)[i] += offset;
        return discrete.at(a, b, controls, h, t).lagrangian;
      };
      derivative[i] =
          (45.0L * (at(step) - at(-step)) - 9.0L * (at(2 * step) - at(-2 * step)) + (at(3 * step) - at(-3 * step))) /
          (60.0L * step);
    }
    return derivative;
  }
};

TEST_P(DiscreteLagrangianTest, MomentaAreDerivativesOfTheDiscreteLagrangianAndDiscreteForces) {
  const DiscreteObjects objects = discrete.at(q_0, q_1, controls, h, t);
  EXPECT_LT((objects.left_momentum + difference(true) + objects.left_force).norm(), 1e-12L);
  EXPECT_LT((objects.right_momentum - difference(false) - objects.right_force).norm(), 1e-12L);
}

TEST_P(DiscreteLagrangianTest, ForcesVanishWithoutControlAndDamping) {
  const tests::Pendulum pendulum;
  const DiscreteObjects objects = DiscreteLagrangian(pendulum, gauss_tableau(GetParam()))
                                      .at(q_0.head(1), q_1.head(1), LongMatrix::Zero(GetParam(), 1), h, t);
  EXPECT_EQ(objects.left_force.norm(), 0.0L);
  EXPECT_EQ(objects.right_force.norm(), 0.0L);
}

INSTANTIATE_TEST_SUITE_P(Stages, DiscreteLagrangianTest, testing::Values(1, 2, 3));

TEST(DiscreteLagrangian, OfTheMidpointRuleIsWhatItIsByHand) {
  const tests::HarmonicOscillator oscillator;
  const LongVector a = LongVector::Constant(1, 0.4L);
  const LongVector b = LongVector::Constant(1, 0.6L);
  const LongMatrix u = LongMatrix::Constant(1, 1, 0.8L);
  const DiscreteObjects objects = DiscreteLagrangian(oscillator, gauss_tableau(1)).at(a, b, u, 0.5L, 0.0L);
  const long double slope = 0.2L / 0.5L;
  EXPECT_NEAR(static_cast<double>(objects.lagrangian),
              static_cast<double>(0.5L * (0.5L * slope * slope - 2.0L * 0.25L)), 1e-15);
  EXPECT_NEAR(static_cast<double>(objects.left_force[0]), 0.25 * 0.8, 1e-15);
  EXPECT_NEAR(static_cast<double>(objects.right_force[0]), 0.25 * 0.8, 1e-15);
}

}  // namespace
}  // namespace dmocbench
