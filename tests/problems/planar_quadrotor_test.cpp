#include "problems/planar_quadrotor.hpp"

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "problems/planar_quadrotor_flip.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

TEST(PlanarQuadrotor, ObeysNewtonAndEuler) {
  const PlanarQuadrotor problem;
  EquationsOfMotion motion{TracedProblem(problem)};
  tests::RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d q = random.vector(3, -3.0, 3.0);
    const Eigen::Vector2d u = random.vector(2, -5.0, 5.0);
    // Thrust along the body's axis (-sin θ, cos θ); the right rotor lifts the right side.
    const Eigen::Vector2d axis(-std::sin(q[2]), std::cos(q[2]));
    Eigen::Vector3d expected;
    expected << u.sum() / 0.486 * axis - Eigen::Vector2d(0.0, 9.81), 0.25 * (u[0] - u[1]) / 0.00383;
    EXPECT_LT((motion.acceleration(q, random.vector(3), u, 0.0) - expected).norm(), 1e-11);
  }
}

TEST(PlanarQuadrotor, HoversUnderItsGuessedThrust) {
  const PlanarQuadrotor problem;
  EquationsOfMotion motion{TracedProblem(problem)};
  const MotionPoint point = problem.guess(0.7);
  EXPECT_LT(motion.acceleration(point.q, point.v, point.u, 0.0).norm(), 1e-13);
}

TEST(PlanarQuadrotor, MayPushUpOnlyAndToTheWeightByOption) {
  PlanarQuadrotor problem;
  EXPECT_TRUE(problem.bounds().u.empty());
  problem.set_parameter("bounded", 1.0);
  EXPECT_EQ(problem.bounds().u.lower, Eigen::Vector2d::Zero());
  EXPECT_NEAR(problem.bounds().u.upper[1], 0.486 * 9.81, 1e-15);
}

TEST(PlanarQuadrotor, IsSymmetricUnderHorizontalTranslations) { tests::expect_translation(PlanarQuadrotor()); }

TEST(PlanarQuadrotorFlip, TurnsOnceOnTheSpotInASecond) {
  const PlanarQuadrotorFlip problem;
  EXPECT_EQ(problem.final_state().q.head(2), problem.initial_state().q.head(2));
  EXPECT_EQ(problem.final_state().q[2], 2.0 * std::numbers::pi);
  EXPECT_EQ(problem.horizon(), 1.0);
  EXPECT_EQ(PlanarQuadrotor().horizon(), 1.5);
}

}  // namespace
}  // namespace dmocbench
