#include "problems/spherical_pendulum.hpp"

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

std::unique_ptr<SphericalPendulum> heavy() {
  auto problem = std::make_unique<SphericalPendulum>();
  problem->set_parameter("mass", 1.7);
  problem->set_parameter("length", 0.8);
  return problem;
}

TEST(SphericalPendulum, BeginsAndEndsOnSteadyCones) {
  const auto problem = heavy();
  EquationsOfMotion motion{TracedProblem(*problem)};
  for (const BoundaryState& state : {problem->initial_state(), problem->final_state()}) {
    EXPECT_LT(motion.acceleration(state.q, state.v, Eigen::Vector2d::Zero(), 0.0).norm(), 1e-14);
    EXPECT_GT(state.v[1], 1.0);
  }
}

TEST(SphericalPendulum, ObeysTheEquationsOfTheSphere) {
  const auto problem = heavy();
  const double inertia = 1.7 * 0.8 * 0.8;
  EquationsOfMotion motion{TracedProblem(*problem)};
  tests::RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector2d q(random.number(0.3, 2.8), random.number(-3.0, 3.0));
    const Eigen::Vector2d v = random.vector(2, -3.0, 3.0);
    const Eigen::Vector2d u = random.vector(2, -3.0, 3.0);
    const double s = std::sin(q[0]);
    const double c = std::cos(q[0]);
    const Eigen::Vector2d expected(s * c * v[1] * v[1] - 9.81 / 0.8 * s + u[0] / inertia,
                                   -2.0 * c / s * v[0] * v[1] + u[1] / (inertia * s * s));
    EXPECT_LT((motion.acceleration(q, v, u, 0.0) - expected).norm(), 1e-12 * (1.0 + expected.norm()));
  }
}

TEST(SphericalPendulum, HasTheEnergiesOfItsBob) {
  const auto problem = heavy();
  tests::RandomPoints random;
  const auto bob = [&](const Eigen::Vector2d& q) {
    auto at = tests::picture_at(*problem, {q, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()});
    return Eigen::Vector3d(at["bob_x"], at["bob_y"], at["bob_z"]);
  };
  constexpr double e = 1e-4;
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Vector2d q = random.vector(2, -3.0, 3.0);
    const Eigen::Vector2d v = random.vector(2, -3.0, 3.0);
    const Eigen::Vector3d velocity = (bob(q + e * v) - bob(q - e * v)) / (2.0 * e);
    EXPECT_NEAR(bob(q).norm(), 0.8, 1e-14);
    EXPECT_NEAR(tests::lagrangian_at(*problem, q, v), 1.7 * (0.5 * velocity.squaredNorm() - 9.81 * bob(q)[2]), 1e-6);
  }
}

TEST(SphericalPendulum, DoesNotKnowItsAzimuth) {
  const SphericalPendulum problem;
  const Eigen::Vector2d v(0.4, 1.2);
  EXPECT_EQ(tests::generator_at(problem, v), Eigen::Vector2d(0.0, 1.0));
  EXPECT_EQ(tests::lagrangian_at(problem, Eigen::Vector2d(0.7, 0.1), v),
            tests::lagrangian_at(problem, Eigen::Vector2d(0.7, 2.3), v));
}

TEST(SphericalPendulum, ReachesItsReference) {
  const SphericalPendulum problem;
  const ReferenceOptimum reference = tests::value_of(problem.card().reference);
  for (const std::string& method : paper_families()) {
    const Trajectory found = tests::solve(problem, {method, 3}, Grid::uniform(16), guessed_motion(problem)).trajectory;
    EXPECT_NEAR(found.cost, reference.objective, 1e-6 * reference.objective) << method;
  }
}

TEST(SphericalPendulum, HasNoReferenceForOtherData) { EXPECT_FALSE(heavy()->card().reference.has_value()); }

}  // namespace
}  // namespace dmocbench
