#include "methods/diagnostics/exact_discrete_lagrangian.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

LongVector one(long double entry) { return LongVector::Constant(1, entry); }

ControlFormula no_control(Eigen::Index m) {
  return [m](const Expression&) { return ExpressionVector(ExpressionVector::Constant(m, 0.0)); };
}

TEST(ExactDiscreteLagrangian, OfTheOscillatorIsItsClosedForm) {
  const tests::HarmonicOscillator oscillator;
  constexpr long double omega = tests::HarmonicOscillator::omega;
  const long double h = 0.7L;
  const ExactInterval motion =
      ExactDiscreteLagrangian(oscillator, no_control(1)).between(one(0.3L), one(0.5L), one(0.0L), h);
  const long double closed =
      omega / (2.0L * std::sin(omega * h)) * ((0.3L * 0.3L + 0.5L * 0.5L) * std::cos(omega * h) - 2.0L * 0.3L * 0.5L);
  EXPECT_LT(std::abs(motion.objects.lagrangian - closed), 1e-16L);
  EXPECT_LT(std::abs(motion.q_1[0] - 0.5L), 1e-17L);
}

TEST(ExactDiscreteLagrangian, ForcesOfALinearControlOnAFreeParticleAreTheirIntegrals) {
  const tests::DoubleIntegrator particle;
  const auto control = [](const Expression& t) {
    return ExpressionVector(ExpressionVector::Constant(1, 2.0 + 3.0 * t));
  };
  const long double h = 0.4L;
  const ExactInterval motion = ExactDiscreteLagrangian(particle, control).along(one(0.1L), one(0.9L), h);
  // ∂q/∂q_1 = t/h, ∂q/∂q_0 = 1 - t/h.
  EXPECT_LT(std::abs(motion.objects.right_force[0] - (h + h * h)), 1e-17L);
  EXPECT_LT(std::abs(motion.objects.left_force[0] - (h + 0.5L * h * h)), 1e-17L);
}

TEST(ExactDiscreteLagrangian, LegendreTransformsAreThoseOfTheLagrangianAtTheEnds) {
  const tests::MovingFrame problem;
  const auto control = [](const Expression& t) {
    ExpressionVector u(2);
    u << sin(2.0 * t), 0.3 + cos(t);
    return u;
  };
  const ExactDiscreteLagrangian exact(problem, control);
  const long double h = 0.5L;
  const ExactInterval motion =
      exact.along(problem.initial_state().q.cast<long double>(), problem.initial_state().v.cast<long double>(), h);
  constexpr long double step = 2e-3L;
  for (Eigen::Index i = 0; i < 2; ++i) {
    for (const bool of_left : {true, false}) {
      const auto at = [&](long double offset) {
        LongVector a = motion.q_0;
        LongVector b = motion.q_1;
        (of_left ? a : b)[i] += offset;
        return exact.between(a, b, motion.v_0, h).objects.lagrangian;
      };
      const long double derivative =
          (45.0L * (at(step) - at(-step)) - 9.0L * (at(2 * step) - at(-2 * step)) + (at(3 * step) - at(-3 * step))) /
          (60.0L * step);
      const DiscreteObjects& objects = motion.objects;
      const long double expected = of_left ? -objects.left_momentum[i] - objects.left_force[i]
                                           : objects.right_momentum[i] - objects.right_force[i];
      EXPECT_LT(std::abs(derivative - expected), 1e-12L);
    }
  }
}

TEST(ExactDiscreteLagrangian, RefusesConfigurationsThatNoMotionJoins) {
  const tests::HarmonicOscillator oscillator;
  const long double half_period = std::acos(-1.0L) / tests::HarmonicOscillator::omega;  // every motion ends at -q_0
  const ExactDiscreteLagrangian exact(oscillator, no_control(1));
  EXPECT_THROW(static_cast<void>(exact.between(one(0.3L), one(0.5L), one(0.0L), half_period)), Error);
}

}  // namespace
}  // namespace dmocbench
