#include <numbers>

#include <gtest/gtest.h>

#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {
namespace {

/// q = (t, t²) with one control, over 2.
Motion parabola() {
  return {
      [](double t) {
        return MotionPoint{Eigen::Vector2d(t, t * t), Eigen::Vector2d(1.0, 2.0 * t), Eigen::VectorXd::Constant(1, t)};
      },
      2.0};
}

TEST(BentMotion, AddsSinesOfFallingPeriodsAndTheirRates) {
  Eigen::MatrixXd amplitudes(2, 2);
  amplitudes << 0.5, 0.0, -1.0, 0.25;
  const Motion motion = bent(parabola(), amplitudes);
  EXPECT_EQ(motion.horizon, 2.0);
  const double half = 0.5 * std::numbers::pi;  // π t / T at t = 1
  const MotionPoint middle = motion.at(1.0);
  EXPECT_NEAR(middle.q[0], 1.0 + 0.5, 1e-15);
  EXPECT_NEAR(middle.q[1], 1.0 - 1.0, 1e-15);
  EXPECT_NEAR(middle.v[0], 1.0, 1e-15);
  EXPECT_NEAR(middle.v[1], 2.0 - 0.25 * 2.0 * half, 1e-15);
  EXPECT_EQ(middle.u[0], 1.0);
}

TEST(BentMotion, KeepsTheConfigurationsOfBothEnds) {
  const Motion motion = bent(parabola(), Eigen::MatrixXd::Constant(2, 3, 0.7));
  for (const double t : {0.0, 2.0}) EXPECT_LT((motion.at(t).q - parabola().at(t).q).norm(), 1e-14);
}

TEST(BentMotion, HasTheVelocityOfItsConfiguration) {
  Eigen::MatrixXd amplitudes(2, 3);
  amplitudes << 0.3, -0.2, 0.1, 0.0, 0.4, -0.6;
  const Motion motion = bent(parabola(), amplitudes);
  constexpr double step = 1e-5;
  for (const double t : {0.2, 0.9, 1.7}) {
    const Eigen::VectorXd slope = (motion.at(t + step).q - motion.at(t - step).q) / (2.0 * step);
    EXPECT_LT((slope - motion.at(t).v).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace dmocbench
