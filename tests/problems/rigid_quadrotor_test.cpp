#include "problems/rigid_quadrotor.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

/// The body's angular velocity in its own frame, turn by turn: yaw about e_3, then pitch, then roll.
Vector3d turning(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  const AngleAxisd roll(q[3], Vector3d::UnitX());
  const AngleAxisd pitch(q[4], Vector3d::UnitY());
  const Vector3d of_yaw_and_pitch = pitch.inverse() * (v[5] * Vector3d::UnitZ()) + v[4] * Vector3d::UnitY();
  return roll.inverse() * of_yaw_and_pitch + v[3] * Vector3d::UnitX();
}

TEST(RigidQuadrotor, ObeysNewtonAndEuler) {
  const RigidQuadrotor problem;
  EquationsOfMotion motion{TracedProblem(problem)};
  const Eigen::Array3d moments(0.0046, 0.0046, 0.008);
  tests::RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd q = random.vector(6, -1.2, 1.2);
    const Eigen::VectorXd v = random.vector(6, -2.0, 2.0);
    const Eigen::VectorXd u = random.vector(4, -5.0, 5.0);
    const Eigen::VectorXd a = motion.acceleration(q, v, u, 0.3);
    const Vector3d axis = AngleAxisd(q[5], Vector3d::UnitZ()) * AngleAxisd(q[4], Vector3d::UnitY()) *
                          AngleAxisd(q[3], Vector3d::UnitX()) * Vector3d::UnitZ();
    EXPECT_LT((a.head(3) - (u[0] * axis - 9.8 * Vector3d::UnitZ())).norm(), 1e-11);
    constexpr double step = 1e-5;
    const Vector3d rate = (turning(q + step * v, v + step * a) - turning(q - step * v, v - step * a)) / (2.0 * step);
    const Vector3d omega = turning(q, v);
    const Vector3d angular_momentum = moments * omega.array();
    const Vector3d torque = (moments * rate.array()).matrix() + omega.cross(angular_momentum);
    EXPECT_LT((torque.array() / moments - u.tail(3).array()).matrix().norm(), 1e-7);
  }
}

TEST(RigidQuadrotor, HoversUnderItsGuessedThrust) {
  const RigidQuadrotor problem;
  EquationsOfMotion motion{TracedProblem(problem)};
  const MotionPoint point = problem.guess(0.7);
  EXPECT_LT(motion.acceleration(point.q, point.v, point.u, 0.0).norm(), 1e-13);
}

TEST(RigidQuadrotor, IsSymmetricUnderHorizontalTranslations) { tests::expect_translation(RigidQuadrotor()); }

}  // namespace
}  // namespace dmocbench
