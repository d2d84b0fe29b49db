#include "problems/link_chain.hpp"

#include <gtest/gtest.h>

#include "problems/two_link_manipulator.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

std::unique_ptr<LinkChain> chain_of(int links) {
  auto problem = std::make_unique<LinkChain>();
  problem->set_parameter("links", links);
  return problem;
}

TEST(LinkChain, OfTwoLinksIsTheTwoLinkManipulator) {
  const auto chain = chain_of(2);
  const TwoLinkManipulator arm;
  tests::RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const MotionPoint at{random.vector(2, -3.0, 3.0), random.vector(2, -4.0, 4.0), random.vector(2, -9.0, 9.0)};
    EXPECT_NEAR(tests::lagrangian_at(*chain, at.q, at.v), tests::lagrangian_at(arm, at.q, at.v), 1e-13);
    EXPECT_EQ(tests::force_at(*chain, at), tests::force_at(arm, at));
    EXPECT_NEAR(tests::running_cost_at(*chain, at), tests::running_cost_at(arm, at), 1e-14);
    EXPECT_EQ(tests::generator_at(*chain, at.q), tests::generator_at(arm, at.q));
  }
  EXPECT_EQ(chain->initial_state().q, arm.initial_state().q);
  EXPECT_EQ(chain->final_state().q, arm.final_state().q);
  EXPECT_EQ(chain->initial_state().v, arm.initial_state().v);
  EXPECT_EQ(chain->final_state().v, arm.final_state().v);
  EXPECT_EQ(chain->horizon(), arm.horizon());
  EXPECT_EQ(tests::value_of(chain->card().reference).objective, tests::value_of(arm.card().reference).objective);
}

TEST(LinkChain, HasTheEnergiesOfRodsComputedFromTheirTips) {
  for (const int n : {1, 3, 5}) {
    const auto chain = chain_of(n);
    chain->set_parameter("mass", 1.3);
    chain->set_parameter("length", 0.7);
    // Tips one below the other; the first joint is the origin.
    const auto tips = [&](const Eigen::VectorXd& q) {
      auto named = tests::picture_at(*chain, {q, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)});
      Eigen::MatrixX2d positions = Eigen::MatrixX2d::Zero(n + 1, 2);
      for (int i = 1; i <= n; ++i) {
        const std::string name = "tip_" + std::to_string(i);
        positions.row(i) << named[name + "_x"], named[name + "_y"];
      }
      return positions;
    };
    tests::RandomPoints random;
    const Eigen::VectorXd q = random.vector(n, -3.0, 3.0);
    const Eigen::VectorXd v = random.vector(n, -2.0, 2.0);
    constexpr double e = 1e-4;
    const Eigen::MatrixX2d at = tips(q);
    const Eigen::MatrixX2d rate = (tips(q + e * v) - tips(q - e * v)) / (2.0 * e);
    double expected = 0.0;
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR((at.row(i + 1) - at.row(i)).norm(), 0.7, 1e-14);
      // A rod's kinetic energy from the velocities a and b of its ends: m (|a|² + a·b + |b|²)/6.
      const Eigen::RowVector2d a = rate.row(i);
      const Eigen::RowVector2d b = rate.row(i + 1);
      expected += 1.3 * (a.squaredNorm() + a.dot(b) + b.squaredNorm()) / 6.0;
      expected -= 1.3 * 9.81 * 0.5 * (at(i, 1) + at(i + 1, 1));
    }
    EXPECT_NEAR(tests::lagrangian_at(*chain, q, v), expected, 1e-6) << n;
  }
}

TEST(LinkChain, DoesTheWorkOfItsMotors) {
  // Motor i turns rod i against rod i - 1.
  const auto chain = chain_of(4);
  tests::RandomPoints random;
  const MotionPoint at{random.vector(4), random.vector(4), random.vector(4)};
  double power = at.u[0] * at.v[0];
  for (int i = 1; i < 4; ++i) power += at.u[i] * (at.v[i] - at.v[i - 1]);
  EXPECT_NEAR(tests::force_at(*chain, at).dot(at.v), power, 1e-15);
}

TEST(LinkChain, HasAKineticEnergyThatRotationsLeaveAlone) {
  const auto chain = chain_of(3);
  chain->set_parameter("gravity", 0.0);
  tests::RandomPoints random;
  const Eigen::VectorXd q = random.vector(3, -3.0, 3.0);
  const Eigen::VectorXd v = random.vector(3);
  EXPECT_NEAR(tests::lagrangian_at(*chain, q + 0.6 * tests::generator_at(*chain, q), v),
              tests::lagrangian_at(*chain, q, v), 1e-14);
}

TEST(LinkChain, ReachesItsReferenceFromItsFoldedGuess) {
  for (const int n : {1, 2, 3}) {
    const auto chain = chain_of(n);
    const double reference = tests::value_of(chain->card().reference).objective;
    const Trajectory found = tests::solve(*chain, {"dmoc", 2}, Grid::uniform(64), guessed_motion(*chain)).trajectory;
    EXPECT_NEAR(found.cost, reference, 2e-4 * reference) << n;
  }
}

}  // namespace
}  // namespace dmocbench
