#include "problems/hang_glider.hpp"

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

/// Acceleration in m/s² as COPS states it: lift across, drag along the velocity through the air, whose angle is η.
Eigen::Vector2d cops_acceleration(double x, double v_x, double v_y, double lift) {
  const double r = std::pow(x / 100.0 - 2.5, 2);
  const double updraft = 2.5 * (1.0 - r) * std::exp(-r);
  const double w = v_y - updraft;
  const double speed = std::hypot(v_x, w);
  const double sine = w / speed;
  const double cosine = v_x / speed;
  const double drag_force = 0.5 * (0.034 + 0.069662 * lift * lift) * 1.13 * 14.0 * speed * speed;
  const double lift_force = 0.5 * lift * 1.13 * 14.0 * speed * speed;
  return {(-lift_force * sine - drag_force * cosine) / 100.0, (lift_force * cosine - drag_force * sine) / 100.0 - 9.81};
}

TEST(HangGlider, AcceleratesAsCopsStatesInItsUnits) {
  const HangGlider problem;
  EquationsOfMotion motion{TracedProblem(problem)};
  tests::RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const double x = random.number(0.0, 600.0);
    const Eigen::Vector2d velocity(random.number(5.0, 20.0), random.number(-4.0, 4.0));
    const double lift = random.number(0.0, 1.4);
    // 100 m and 10 s: accelerations are in m/s².
    const Eigen::Vector2d found =
        motion.acceleration(Eigen::Vector2d(x / 100.0, 9.5), velocity / 10.0, Eigen::VectorXd::Constant(1, lift), 0.0);
    EXPECT_LT((found - cops_acceleration(x, velocity[0], velocity[1], lift)).norm(), 1e-11);
  }
}

TEST(HangGlider, LosesEnergyInStillAirByDragAlone) {
  HangGlider problem;
  problem.set_parameter("updraft", 0.0);
  tests::RandomPoints random;
  for (int trial = 0; trial < 10; ++trial) {
    const MotionPoint at{random.vector(2), random.vector(2), Eigen::VectorXd::Constant(1, random.number(0.0, 1.4))};
    const double speed = at.v.norm();
    const double drag = 0.034 + 0.069662 * at.u[0] * at.u[0];
    EXPECT_NEAR(tests::force_at(problem, at).dot(at.v), -0.5 * 1.13 * 0.14 * 100.0 * drag * std::pow(speed, 3), 1e-11);
  }
}

TEST(HangGlider, RisesInTheThermalAndSinksBesideIt) {
  const HangGlider problem;
  const auto updraft = [&](double x) {
    return tests::picture_at(problem,
                             {Eigen::Vector2d(x, 10.0), Eigen::Vector2d(1.3, -0.1), Eigen::VectorXd::Constant(1, 0.7)})
        .at("updraft");
  };
  EXPECT_NEAR(updraft(2.5), 2.5, 1e-14);
  EXPECT_NEAR(updraft(3.5), 0.0, 1e-14);
  EXPECT_LT(updraft(4.0), 0.0);
  EXPECT_NEAR(updraft(9.0), 0.0, 1e-12);
}

TEST(HangGlider, StatesItsRangeInMetres) {
  const HangGlider problem;
  EXPECT_EQ(problem.initial_state().q, Eigen::Vector2d(0.0, 10.0));
  EXPECT_EQ(problem.final_state().q[1], 9.0);
  EXPECT_TRUE(problem.bounds().last.q.is_fixed(1));
  EXPECT_FALSE(problem.bounds().last.q.is_fixed(0));
  EXPECT_EQ(problem.card().time_unit.factor, 10.0);
  const Trajectory found = tests::solve(problem, {"dmoc", 1}, Grid::uniform(64), guessed_motion(problem)).trajectory;
  EXPECT_NEAR(found.cost, -100.0 * found.q(64, 0), 1e-9);
  EXPECT_NEAR(found.cost, tests::value_of(problem.card().reference).objective, 10.0);
}

TEST(HangGlider, FliesAsFarAsPublishedByTheMidpointRuleOnTwoHundredIntervals) {
  const HangGlider problem;
  const double found = tests::solve(problem, {"dmoc", 1}, Grid::uniform(200), guessed_motion(problem)).trajectory.cost;
  const std::vector<PublishedOptimum> published = tests::value_of(problem.card().reference).published;
  EXPECT_NEAR(found, published.back().objective, 1e-3);
}

}  // namespace
}  // namespace dmocbench
