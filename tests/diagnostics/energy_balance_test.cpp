#include <cmath>

#include <gtest/gtest.h>

#include "methods/diagnostics/conserved_quantities.hpp"
#include "tests/support/problems_for_tests.hpp"

namespace dmocbench {
namespace {

TEST(Energy, OfARelativisticParticleIsNotTheLagrangianWithAnotherSign) {
  const tests::RelativisticSpring problem;
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, 0.5);
  const Eigen::VectorXd v = Eigen::VectorXd::Constant(1, 0.6);
  Energy energy(problem);
  EXPECT_NEAR(energy.energy(q, v, 0.0), 1.0 / std::sqrt(1.0 - 0.36) + 0.125, 1e-15);
  EXPECT_NEAR(energy.power(q, v, Eigen::VectorXd::Constant(1, 2.0), 0.0), 1.2, 1e-15);
}

/// q = t² under u = 2 on two intervals of length 1, one stage each.
Trajectory uniformly_accelerated() {
  Trajectory motion;
  motion.tableau = gauss_tableau(1);
  motion.node_times = Eigen::Vector3d(0.0, 1.0, 2.0);
  motion.q = Eigen::Vector3d(0.0, 1.0, 4.0);
  motion.v = Eigen::Vector3d(0.0, 2.0, 4.0);
  motion.p = motion.v;
  motion.stage_times = Eigen::Vector2d(0.5, 1.5);
  motion.stage_q = Eigen::Vector2d(0.5, 2.5);
  motion.stage_v = Eigen::Vector2d(1.0, 3.0);
  motion.stage_u = Eigen::Vector2d(2.0, 2.0);
  return motion;
}

TEST(EnergyBalance, ClosesForUniformAcceleration) {
  const EnergyBalance balance = energy_balance(tests::DoubleIntegrator(), uniformly_accelerated());
  EXPECT_DOUBLE_EQ(balance.change, 8.0);
  EXPECT_DOUBLE_EQ(balance.work, 8.0);
  EXPECT_DOUBLE_EQ(balance.largest_work, 8.0);
  EXPECT_LT(balance.largest_gap, 1e-14);
}

TEST(EnergyBalance, SeesAVelocityThatNoForceExplainsAtAnInnerNode) {
  Trajectory motion = uniformly_accelerated();
  motion.v(1, 0) = 3.0;
  EXPECT_NEAR(energy_balance(tests::DoubleIntegrator(), motion).largest_gap, 2.5, 1e-14);
}

}  // namespace
}  // namespace dmocbench
