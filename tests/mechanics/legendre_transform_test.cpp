#include "methods/mechanics/legendre_transform.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;

TEST(LegendreTransform, IsAngularMomentumAndRadialVelocityOnTheOrbit) {
  LegendreTransform legendre{TracedProblem(*make_problem("orbital_transfer"))};
  const Eigen::Vector2d q(1.5, 0.7);
  const Eigen::Vector2d v(-0.2, 0.6);
  EXPECT_LT((legendre.momentum(q, v, 0.0) - Eigen::Vector2d(-0.2, 1.5 * 1.5 * 0.6)).norm(), 1e-15);
  EXPECT_LT((legendre.at(q, v, 0.0).mass - Eigen::Matrix2d(Eigen::Vector2d(1.0, 2.25).asDiagonal())).norm(), 1e-15);
  Eigen::Matrix2d by_configuration;
  by_configuration << 0.0, 0.0, 2.0 * 1.5 * 0.6, 0.0;
  EXPECT_LT((legendre.at(q, v, 0.0).by_configuration - by_configuration).norm(), 1e-15);
}

TEST(LegendreTransform, InvertsItselfForEveryProblem) {
  std::vector<std::unique_ptr<Problem>> problems;
  for (const std::string& name : paper_problem_names()) problems.push_back(make_problem(name));
  problems.push_back(std::make_unique<tests::MovingFrame>());
  RandomPoints random;
  for (const auto& problem : problems) {
    LegendreTransform legendre{TracedProblem(*problem)};
    const Eigen::Index n = problem->configuration_size();
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::VectorXd q = random.vector(n, 0.5, 2.0);
      const Eigen::VectorXd v = random.vector(n, -3.0, 3.0);
      const double t = random.number(0.0, 2.0);
      const Eigen::VectorXd p = legendre.momentum(q, v, t);
      EXPECT_LT((legendre.velocity(q, p, t, random.vector(n)) - v).norm(), 1e-12) << problem->name();
    }
  }
}

TEST(LegendreTransform, OfARelativisticParticleIsItsClosedForm) {
  LegendreTransform legendre{TracedProblem(tests::RelativisticSpring())};
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, 0.3);
  for (const double velocity : {-0.9, -0.5, 0.0, 0.3, 0.8, 0.99}) {
    const Eigen::VectorXd v = Eigen::VectorXd::Constant(1, velocity);
    const double p = velocity / std::sqrt(1.0 - velocity * velocity);
    EXPECT_NEAR(legendre.momentum(q, v, 0.0)[0], p, 1e-13 * (1.0 + std::abs(p)));
    EXPECT_NEAR(legendre.at(q, v, 0.0).mass(0, 0), std::pow(1.0 - velocity * velocity, -1.5), 1e-10);
    // v = p / sqrt(1 + p²). Newton starts on the convex side, nearer to the speed of light, where it cannot overshoot.
    const double gap = 1.0 - std::abs(velocity);
    const Eigen::VectorXd nearby = Eigen::VectorXd::Constant(1, velocity + std::copysign(0.3 * gap, velocity));
    const double inverse = legendre.velocity(q, Eigen::VectorXd::Constant(1, p), 0.0, nearby)[0];
    EXPECT_NEAR(inverse, p / std::sqrt(1.0 + p * p), 1e-13);
  }
}

TEST(LegendreTransform, InvertsItselfHoweverDifferentTheMasses) {
  // The extreme values that the parameters allow: L_vv has a condition number of about 1e12.
  const auto problem = make_problem("two_link_manipulator");
  problem->set_parameter("mass_1", 1e3);
  problem->set_parameter("length_1", 1e3);
  problem->set_parameter("mass_2", 1e-3);
  problem->set_parameter("length_2", 1.0);
  problem->set_parameter("inertia_2", 1e-6);
  LegendreTransform legendre{TracedProblem(*problem)};
  RandomPoints random;
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::VectorXd q = random.vector(2, -3.0, 3.0);
    const Eigen::VectorXd v = random.vector(2, -3.0, 3.0);
    const Eigen::VectorXd p = legendre.momentum(q, v, 0.0);
    const Eigen::VectorXd inverse = legendre.velocity(q, p, 0.0, random.vector(2));
    EXPECT_LT((legendre.momentum(q, inverse, 0.0) - p).norm(), 1e-14 * p.norm());
  }
}

TEST(LegendreTransform, RefusesASingularMass) {
  LegendreTransform legendre{TracedProblem(tests::SingularMass())};
  const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
  tests::expect_error_naming({"not regular", "L_vv"},
                             [&] { static_cast<void>(legendre.velocity(zero, Eigen::Vector2d(1.0, 0.0), 0.0, zero)); });
}

TEST(LegendreTransform, SaysSoWhereNoVelocityHasTheMomentum) {
  /// L = ½ arctan-like: p = tanh v stays below 1.
  class Bounded final : public tests::SmallProblem {
   public:
    Bounded() : SmallProblem("bounded", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1) {}
    [[nodiscard]] Expression lagrangian(const State& x) const override { return log(cosh(x.v[0])); }
  };
  LegendreTransform legendre{TracedProblem(Bounded())};
  const auto number = [](double x) { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, x)); };
  EXPECT_NEAR(legendre.velocity(number(0.0), number(0.5), 0.0, number(0.0))[0], std::atanh(0.5), 1e-14);
  EXPECT_THROW(static_cast<void>(legendre.velocity(number(0.0), number(1.5), 0.0, number(0.0))), Error);
}

}  // namespace
}  // namespace dmocbench
