#include "problems/robot_arm.hpp"

#include <array>

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

MotionPoint somewhere(tests::RandomPoints& random) {
  return {Eigen::Vector3d(random.number(1.0, 4.5), random.number(-3.0, 3.0), random.number(0.3, 2.8)), random.vector(3),
          random.vector(3)};
}

TEST(RobotArm, MovesAsCopsPrescribes) {
  const RobotArm problem;
  EquationsOfMotion motion{TracedProblem(problem)};
  tests::RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const MotionPoint at = somewhere(random);
    const double inertia = (std::pow(5.0 - at.q[0], 3) + std::pow(at.q[0], 3)) / 3.0;
    const Eigen::Vector3d expected(at.u[0] / 5.0, at.u[1] / (inertia * std::pow(std::sin(at.q[2]), 2)),
                                   at.u[2] / inertia);
    EXPECT_LT((motion.acceleration(at.q, at.v, at.u, 0.0) - expected).norm(), 1e-13);
  }
}

TEST(RobotArm, OfTheTrueEquationsKeepsEnergyAndAngularMomentumUnlessItIsPushed) {
  // Ė = u·q̇ and ṗ_θ = u_θ, by differences along the motion; the equations of COPS do neither.
  tests::RandomPoints random;
  constexpr double e = 1e-5;
  for (const bool euler_lagrange : {true, false}) {
    RobotArm problem;
    problem.set_parameter("euler_lagrange", euler_lagrange ? 1.0 : 0.0);
    EquationsOfMotion motion{TracedProblem(problem)};
    LegendreTransform legendre{TracedProblem(problem)};
    double worst = 0.0;
    for (int trial = 0; trial < 10; ++trial) {
      const MotionPoint at = somewhere(random);
      const Eigen::VectorXd a = motion.acceleration(at.q, at.v, at.u, 0.0);
      const auto later = [&](double t) {
        return std::pair<Eigen::VectorXd, Eigen::VectorXd>(at.q + t * at.v, at.v + t * a);
      };
      const auto energy = [&](double t) { return tests::lagrangian_at(problem, later(t).first, later(t).second); };
      const auto turning = [&](double t) { return legendre.momentum(later(t).first, later(t).second, 0.0)[1]; };
      const double power_error = (energy(e) - energy(-e)) / (2.0 * e) - at.u.dot(at.v);
      const double torque_error = (turning(e) - turning(-e)) / (2.0 * e) - at.u[1];
      worst = std::max({worst, std::abs(power_error), std::abs(torque_error)});
    }
    if (euler_lagrange) {
      EXPECT_LT(worst, 1e-7);
    } else {
      EXPECT_GT(worst, 1.0);
    }
  }
}

TEST(RobotArm, DoesNotKnowItsAzimuth) {
  const RobotArm problem;
  const Eigen::Vector3d v(0.4, 1.2, -0.3);
  EXPECT_EQ(tests::generator_at(problem, v), Eigen::Vector3d(0.0, 1.0, 0.0));
  EXPECT_EQ(tests::lagrangian_at(problem, Eigen::Vector3d(4.0, 0.1, 0.8), v),
            tests::lagrangian_at(problem, Eigen::Vector3d(4.0, 2.1, 0.8), v));
}

TEST(RobotArm, ComesNearItsReferenceOnACoarseGrid) {
  // A grid that does not know the switching times.
  for (const bool euler_lagrange : {true, false}) {
    RobotArm problem;
    problem.set_parameter("euler_lagrange", euler_lagrange ? 1.0 : 0.0);
    const double reference = tests::value_of(problem.card().reference).objective;
    const Trajectory found = tests::solve(problem, {"dmoc", 1}, Grid::uniform(24), guessed_motion(problem)).trajectory;
    EXPECT_NEAR(found.cost, reference, 0.02 * reference);
    EXPECT_LT(found.stage_u.lpNorm<Eigen::Infinity>(), 1.0 + 1e-9);
  }
}

TEST(RobotArm, ReachesItsReferenceOnAGridWithItsSwitchingTimes) {
  const std::array<double, 7> switches{0.0, 0.25, 0.3058824, 0.5, 1.0 - 0.3058824, 0.75, 1.0};
  constexpr Eigen::Index per_arc = 6;
  Eigen::VectorXd nodes(6 * per_arc + 1);
  for (Eigen::Index k = 0; k < 6 * per_arc; ++k) {
    const auto arc = static_cast<std::size_t>(k / per_arc);
    const double fraction = static_cast<double>(k % per_arc) / per_arc;
    nodes[k] = switches[arc] + fraction * (switches[arc + 1] - switches[arc]);
  }
  nodes[6 * per_arc] = 1.0;
  const RobotArm problem;
  const Trajectory found =
      tests::solve(problem, {"dmoc", 3}, Grid::from_nodes(nodes), guessed_motion(problem), 1e-11).trajectory;
  EXPECT_NEAR(found.cost, tests::value_of(problem.card().reference).objective, 1e-7);
  EXPECT_GT(found.stage_u.cwiseAbs().minCoeff(), 0.99);  // bang-bang
}

}  // namespace
}  // namespace dmocbench
