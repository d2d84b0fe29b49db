#include "problems/hovercraft.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

TEST(Hovercraft, ObeysNewtonAndEuler) {
  Hovercraft problem;
  problem.set_parameter("mass", 1.4);
  EquationsOfMotion motion{TracedProblem(problem)};
  tests::RandomPoints random;
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::VectorXd q = random.vector(3, -3.0, 3.0);
    const Eigen::Vector2d u = random.vector(2);
    const Eigen::Vector2d force = Eigen::Rotation2Dd(q[2]) * u;
    const Eigen::Vector3d expected(force[0] / 1.4, force[1] / 1.4, -0.1 * u[1] / 0.05);
    EXPECT_LT((motion.acceleration(q, random.vector(3), u, 0.0) - expected).norm(), 1e-14);
  }
}

TEST(Hovercraft, IsPushedAtItsStern) {
  // The power of the controls is that of the force R(θ)u at the stern.
  const Hovercraft problem;
  tests::RandomPoints random;
  const auto stern = [&](const Eigen::VectorXd& q) {
    auto at = tests::picture_at(problem, {q, Eigen::Vector3d::Zero(), Eigen::Vector2d::Zero()});
    return Eigen::Vector2d(at["stern_x"], at["stern_y"]);
  };
  constexpr double e = 1e-5;
  for (int trial = 0; trial < 10; ++trial) {
    const MotionPoint at{random.vector(3, -3.0, 3.0), random.vector(3), random.vector(2)};
    const Eigen::Vector2d velocity = (stern(at.q + e * at.v) - stern(at.q - e * at.v)) / (2.0 * e);
    const Eigen::Vector2d force = Eigen::Rotation2Dd(at.q[2]) * at.u;
    EXPECT_NEAR(tests::force_at(problem, at).dot(at.v), force.dot(velocity), 1e-9);
  }
}

TEST(Hovercraft, KeepsItsAngularMomentumWithoutControls) {
  // d/dt (m(xẏ - yẋ) + Jθ̇) = f·ξ, and a force through the origin has no moment about it.
  const Hovercraft problem;
  const Eigen::Vector3d q(0.3, -0.2, 0.9);
  EXPECT_EQ(tests::generator_at(problem, q), Eigen::Vector3d(0.2, 0.3, 1.0));
  const MotionPoint at{Eigen::Vector3d(0.1 * std::cos(0.9), 0.1 * std::sin(0.9), 0.9), Eigen::Vector3d::Zero(),
                       Eigen::Vector2d(0.4, 0.7)};  // the stern is at the origin
  EXPECT_NEAR(tests::force_at(problem, at).dot(tests::generator_at(problem, at.q)), 0.0, 1e-16);
}

TEST(Hovercraft, ReachesItsReference) {
  const Hovercraft problem;
  const ReferenceOptimum reference = tests::value_of(problem.card().reference);
  for (const std::string& method : paper_families()) {
    const Trajectory found = tests::solve(problem, {method, 3}, Grid::uniform(16), guessed_motion(problem)).trajectory;
    EXPECT_NEAR(found.cost, reference.objective, 1e-6 * reference.objective) << method;
  }
}

}  // namespace
}  // namespace dmocbench
