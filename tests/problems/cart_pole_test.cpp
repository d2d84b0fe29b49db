#include "problems/cart_pole.hpp"

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

/// The equations as the tutorial prints them, solved for the accelerations.
Eigen::Vector2d printed_acceleration(const Problem& problem, double theta, double omega, double u) {
  const double m1 = problem.parameter("cart_mass");
  const double m2 = problem.parameter("bob_mass");
  const double l = problem.parameter("length");
  const double g = problem.parameter("gravity");
  const double s = std::sin(theta);
  const double c = std::cos(theta);
  return {(l * m2 * s * omega * omega + u + m2 * g * c * s) / (m1 + m2 * s * s),
          -(l * m2 * c * s * omega * omega + u * c + (m1 + m2) * g * s) / (l * m1 + l * m2 * s * s)};
}

TEST(CartPole, ObeysTheEquationsOfTheTutorial) {
  CartPole problem;
  problem.set_parameter("cart_mass", 1.3);
  problem.set_parameter("length", 0.7);
  EquationsOfMotion motion{TracedProblem(problem)};
  tests::RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector2d q = random.vector(2, -3.0, 3.0);
    const Eigen::Vector2d v = random.vector(2, -5.0, 5.0);
    const double u = random.number(-20.0, 20.0);
    const Eigen::Vector2d expected = printed_acceleration(problem, q[1], v[1], u);
    EXPECT_LT((motion.acceleration(q, v, Eigen::VectorXd::Constant(1, u), 0.0) - expected).norm(), 1e-11);
  }
}

TEST(CartPole, BeginsAndEndsInEquilibriumAtRest) { tests::expect_equilibrium_at_ends(CartPole(), 1e-14); }

TEST(CartPole, DropsItsBoundsByOption) {
  CartPole problem;
  EXPECT_EQ(problem.bounds().u.upper[0], 20.0);
  EXPECT_EQ(problem.bounds().q.lower[0], -2.0);
  EXPECT_FALSE(problem.bounds().q.is_bounded(1));
  problem.set_parameter("bounded", 0.0);
  EXPECT_TRUE(problem.bounds().u.empty());
  EXPECT_TRUE(problem.bounds().q.empty());
}

TEST(CartPole, IsSymmetricUnderTranslationsOfTheCart) { tests::expect_translation(CartPole()); }

TEST(CartPole, PicturesABobAtTheLengthOfThePole) {
  auto named = tests::picture_at(
      CartPole(), {Eigen::Vector2d(0.4, 2.0), Eigen::Vector2d::Zero(), Eigen::VectorXd::Constant(1, 3.0)});
  EXPECT_NEAR(std::hypot(named["bob_x"] - named["cart_x"], named["bob_y"]), 0.5, 1e-15);
  EXPECT_GT(named["bob_y"], 0.0);  // above the cart beyond π/2
  EXPECT_EQ(named["force"], 3.0);
}

}  // namespace
}  // namespace dmocbench
