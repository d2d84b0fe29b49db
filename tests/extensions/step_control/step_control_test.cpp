#include <cmath>

#include <gtest/gtest.h>

#include "bench/extensions/step_control/controlled_steps.hpp"
#include "bench/extensions/step_control/kepler_ellipse.hpp"
#include "bench/extensions/step_control/reference_transfer.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

constexpr double exponent = 1.5;

TEST(KeplerEllipse, FreeMotionSolvesTheEquationsOfMotion) {
  const KeplerEllipse ellipse(0.8);
  EquationsOfMotion equations{TracedProblem(ellipse)};
  constexpr double step = 1e-5;
  for (const double t : {0.0, 0.4, 2.0, 5.9}) {
    const MotionPoint at = ellipse.free_motion(t);
    const MotionPoint before = ellipse.free_motion(t - step);
    const MotionPoint behind = ellipse.free_motion(t + step);
    EXPECT_LT(((behind.q - before.q) / (2.0 * step) - at.v).norm(), 1e-7);
    EXPECT_LT(((behind.v - before.v) / (2.0 * step) - equations.acceleration(at.q, at.v, at.u, t)).norm(), 1e-6);
  }
  EXPECT_LT((ellipse.free_motion(0.0).v - ellipse.initial_state().v).norm(), 1e-14);
}

TEST(ControlledSteps, TakeOnePeriodInTheirStepsAndAreSmallAtThePericentre) {
  for (const SigmaReads sigma : {SigmaReads::distance, SigmaReads::acceleration}) {
    for (const StepPolicy rule : {StepPolicy::variational, StepPolicy::imposed, StepPolicy::from_left}) {
      const ControlledSteps steps(0.6, {rule, sigma, 2}, 256, exponent);
      const auto error = steps.error_of_a_period();
      EXPECT_LT(error.state, 1e-2) << name_of(rule) << " " << name_of(sigma);
      const double ratio = sigma == SigmaReads::distance ? std::pow(4.0, exponent) : 4.0;  // r = 0.4 to 1.6
      EXPECT_NEAR(error.largest_step / error.smallest_step, ratio, 0.03 * ratio)
          << name_of(rule) << " " << name_of(sigma);
    }
  }
}

TEST(ControlledSteps, AreBetterThanUniformOnesOnAnEccentricEllipse) {
  const auto error = [](const StepChoice& choice) {
    return ControlledSteps(0.8, choice, 128, exponent).error_of_a_period().state;
  };
  const double uniform = error({});
  EXPECT_GT(uniform, 5.0 * error({StepPolicy::variational, SigmaReads::distance}));
  EXPECT_GT(uniform, error({StepPolicy::imposed, SigmaReads::distance}));
}

TEST(ControlledSteps, RefuseAFunctionThatVanishes) {
  const StepChoice choice{StepPolicy::variational, SigmaReads::distance};
  tests::expect_error_naming({"positive"}, [&] { static_cast<void>(ControlledSteps(0.8, choice, 64, 1000.0)); });
}

TEST(ReferenceTransfer, IsTheCertifiedOptimumOfThePaperAndOfTenRevolutions) {
  for (const int revolutions : {2, 10}) {
    const ReferenceTransfer reference("orbital_transfer", revolutions, SolverOptions{});
    EXPECT_EQ(reference.kind(), "indirect");
    EXPECT_GE(reference.digits(), ReferenceTransfer::wanted_digits);
    const double optimum = tests::value_of(reference.problem()->card().reference).objective;
    EXPECT_NEAR(reference.cost() / optimum, 1.0, 1e-10);
    EXPECT_NEAR(reference.motion().horizon / reference.problem()->horizon(), 1.0, 1e-14);
  }
}

}  // namespace
}  // namespace dmocbench
