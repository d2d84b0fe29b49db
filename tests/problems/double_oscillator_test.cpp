#include "problems/double_oscillator.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

TEST(DoubleOscillator, ObeysTheEquationsOfItsSource) {
  const DoubleOscillator problem;
  EquationsOfMotion motion{TracedProblem(problem)};
  tests::RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd x = random.vector(2);
    const Eigen::VectorXd v = random.vector(2);
    const Eigen::VectorXd u = random.vector(1);
    const double t = random.number(0.0, 6.0);
    const Eigen::Vector2d expected(-1.03 * x[0] + 0.03 * x[1] + 0.01 * std::sin(t),
                                   1.5 * (x[0] - x[1]) - 0.25 * (1.0 - u[0]) * v[1]);
    EXPECT_LT((motion.acceleration(x, v, u, t) - expected).norm(), 1e-14);
  }
}

TEST(DoubleOscillator, LosesInItsDamperWhatTheControlLeavesOpen) {
  const DoubleOscillator problem;
  const MotionPoint closed{Eigen::Vector2d(0.1, 0.2), Eigen::Vector2d(0.7, -3.0), Eigen::VectorXd::Constant(1, 1.0)};
  EXPECT_EQ(tests::force_at(problem, closed)[1], 0.0);
  MotionPoint open = closed;
  open.u[0] = -1.0;
  EXPECT_NEAR(tests::force_at(problem, open).dot(open.v), -2.0 * 0.5 * 9.0, 1e-14);
  EXPECT_NEAR(tests::force_at(problem, open, 0.5 * std::numbers::pi)[0], 1.0, 1e-15);
}

TEST(DoubleOscillator, ReachesItsReferenceWithVelocitiesOfItsOwnChoice) {
  const DoubleOscillator problem;
  const ReferenceOptimum reference = tests::value_of(problem.card().reference);
  for (const std::string& method : paper_families()) {
    const Trajectory found = tests::solve(problem, {method, 3}, Grid::uniform(32), guessed_motion(problem)).trajectory;
    EXPECT_NEAR(found.cost, reference.objective, 1e-6 * reference.objective) << method;
    EXPECT_EQ(found.q.row(0).norm(), 0.0);
    EXPECT_GT(found.v.row(0).norm(), 1e-4);
  }
}

TEST(DoubleOscillator, HasThePublishedValuesOnTheirGrids) {
  const DoubleOscillator problem;
  const auto cost = [&](const tests::Scheme& scheme) {
    return tests::solve(problem, scheme, Grid::uniform(200), guessed_motion(problem)).trajectory.cost;
  };
  const std::vector<PublishedOptimum> published = tests::value_of(problem.card().reference).published;
  EXPECT_NEAR(cost({"tangent", 1}), published.at(0).objective, 1e-9);                    // midpoint rule
  EXPECT_NEAR(cost({"tangent", 2, "lobatto_shared"}), published.at(1).objective, 1e-9);  // trapezoidal rule
}

}  // namespace
}  // namespace dmocbench
