#include "problems/container_crane.hpp"

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

TEST(ContainerCrane, MovesAsTeoAndGohState) {
  const ContainerCrane problem;
  EquationsOfMotion motion{TracedProblem(problem)};
  tests::RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d q(random.number(0.0, 10.0), random.number(10.0, 22.0), random.number());
    const Eigen::VectorXd v = random.vector(3);
    const Eigen::VectorXd u = random.vector(2);
    const Eigen::Vector3d expected(u[0] + 17.2656 * q[2], u[1], -(u[0] + 27.0756 * q[2] + 2.0 * v[1] * v[2]) / q[1]);
    EXPECT_LT((motion.acceleration(q, v, u, 0.0) - expected).norm(), 1e-13 * (1.0 + expected.norm()));
  }
}

TEST(ContainerCrane, CostsWhatItSwingsAndTheControlsByOption) {
  ContainerCrane problem;
  const MotionPoint at{Eigen::Vector3d(1.0, 20.0, 0.3), Eigen::Vector3d(1.0, 0.2, 0.5), Eigen::Vector2d(2.0, 0.5)};
  EXPECT_NEAR(tests::running_cost_at(problem, at), 0.5 * (0.09 + 0.25), 1e-16);
  problem.set_parameter("control_weight", 0.01);
  EXPECT_NEAR(tests::running_cost_at(problem, at), 0.5 * (0.09 + 0.25 + 0.01 * 4.25), 1e-16);
}

TEST(ContainerCrane, ComesNearItsReferenceWithinItsBounds) {
  ContainerCrane problem;
  problem.set_parameter("control_weight", 0.01);
  const double reference = tests::value_of(problem.card().reference).objective;
  for (const std::string& method : paper_families()) {
    const Trajectory found = tests::solve(problem, {method, 1}, Grid::uniform(48), guessed_motion(problem)).trajectory;
    EXPECT_NEAR(found.cost, reference, 1e-2 * reference) << method;
    EXPECT_LT(found.stage_v.col(0).maxCoeff(), 2.5 + 1e-9);
    EXPECT_GT(found.stage_v.col(1).minCoeff(), -1.0 - 1e-9);
  }
}

}  // namespace
}  // namespace dmocbench
