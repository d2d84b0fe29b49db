#include "problems/two_link_manipulator.hpp"

#include <map>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

using std::numbers::pi;

/// The arm as two rods: where their centres are, nothing else.
struct TwoRods {
  double m1, m2, l1, l2, j1, j2, g;
  explicit TwoRods(const Problem& problem)
      : m1(problem.parameter("mass_1")),
        m2(problem.parameter("mass_2")),
        l1(problem.parameter("length_1")),
        l2(problem.parameter("length_2")),
        j1(problem.parameter("inertia_1")),
        j2(problem.parameter("inertia_2")),
        g(problem.parameter("gravity")) {}

  [[nodiscard]] Eigen::Vector4d centres(const Eigen::Vector2d& q) const {
    const Eigen::Vector2d first = 0.5 * l1 * Eigen::Vector2d(std::cos(q[0]), std::sin(q[0]));
    const Eigen::Vector2d second = 2.0 * first + 0.5 * l2 * Eigen::Vector2d(std::cos(q[1]), std::sin(q[1]));
    return (Eigen::Vector4d() << first, second).finished();
  }
  /// Velocities of the centres by differences along the motion q + t v.
  [[nodiscard]] double kinetic(const Eigen::Vector2d& q, const Eigen::Vector2d& v) const {
    const auto central = [&](double e) -> Eigen::Vector4d {
      return (centres(q + e * v) - centres(q - e * v)) / (2.0 * e);
    };
    constexpr double e = 1e-3;
    const Eigen::Vector4d velocity = (4.0 * central(e / 2.0) - central(e)) / 3.0;
    return 0.5 * m1 * velocity.head(2).squaredNorm() + 0.5 * m2 * velocity.tail(2).squaredNorm() +
           0.5 * j1 * v[0] * v[0] + 0.5 * j2 * v[1] * v[1];
  }
  [[nodiscard]] double potential(const Eigen::Vector2d& q) const {
    const Eigen::Vector4d at = centres(q);
    return g * (m1 * at[1] + m2 * at[3]);
  }
};

std::unique_ptr<TwoLinkManipulator> uneven() {
  auto problem = std::make_unique<TwoLinkManipulator>();
  for (const auto& [name, value] : std::map<std::string, double>{{"mass_1", 1.3},
                                                                 {"mass_2", 0.7},
                                                                 {"length_1", 0.9},
                                                                 {"length_2", 1.2},
                                                                 {"inertia_1", 0.11},
                                                                 {"inertia_2", 0.05}}) {
    problem->set_parameter(name, value);
  }
  return problem;
}

TEST(TwoLinkManipulator, HasTheEnergiesOfTwoRodsComputedFromTheirCentres) {
  const auto problem = uneven();
  const TwoRods rods(*problem);
  tests::RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector2d q = random.vector(2, -3.0, 3.0);
    const Eigen::Vector2d v = random.vector(2, -4.0, 4.0);
    EXPECT_NEAR(tests::lagrangian_at(*problem, q, v), rods.kinetic(q, v) - rods.potential(q), 1e-9);
    EXPECT_NEAR(tests::lagrangian_at(*problem, q, Eigen::Vector2d::Zero()), -rods.potential(q), 1e-13);
  }
}

TEST(TwoLinkManipulator, HasAPositiveDefiniteMassEverywhere) {
  const auto problem = uneven();
  LegendreTransform legendre{TracedProblem(*problem)};
  for (double angle = -pi; angle <= pi; angle += 0.1) {
    const Eigen::Matrix2d mass = legendre.at(Eigen::Vector2d(angle, 0.0), Eigen::Vector2d::Zero(), 0.0).mass;
    EXPECT_GT(mass(0, 0), 0.0);
    EXPECT_GT(mass.determinant(), 0.0);
  }
}

TEST(TwoLinkManipulator, BeginsAndEndsInEquilibriumAtRest) {
  const auto problem = uneven();
  tests::expect_equilibrium_at_ends(*problem, 1e-13);
  const TwoRods rods(*problem);
  EXPECT_LT(rods.potential(problem->initial_state().q), rods.potential(Eigen::Vector2d(0.1, -0.2)));
  EXPECT_GT(rods.potential(problem->final_state().q), rods.potential(Eigen::Vector2d(1.2, 1.9)));
}

TEST(TwoLinkManipulator, HasAKineticEnergyThatRotationsLeaveAlone) {
  const auto problem = uneven();
  problem->set_parameter("gravity", 0.0);
  const Eigen::Vector2d xi = tests::generator_at(*problem, Eigen::Vector2d::Zero());
  tests::RandomPoints random;
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Vector2d q = random.vector(2, -3.0, 3.0);
    const Eigen::Vector2d v = random.vector(2, -4.0, 4.0);
    const double turned = tests::lagrangian_at(*problem, q + random.number() * xi, v);
    EXPECT_NEAR(turned, tests::lagrangian_at(*problem, q, v), 1e-13);
  }
  // Turning one link alone is no symmetry.
  const Eigen::Vector2d v(1.0, 2.0);
  const double turned = tests::lagrangian_at(*problem, Eigen::Vector2d(0.5, 0.0), v);
  EXPECT_GT(std::abs(turned - tests::lagrangian_at(*problem, Eigen::Vector2d::Zero(), v)), 1e-2);
}

TEST(TwoLinkManipulator, DoesTheWorkOfItsTwoMotors) {
  // Motor 1 turns link 1 against the base, motor 2 link 2 against link 1: power τ₁ω₁ + τ₂(ω₂ - ω₁).
  const MotionPoint at{Eigen::Vector2d(0.3, 0.4), Eigen::Vector2d(2.0, -3.0), Eigen::Vector2d(5.0, 7.0)};
  EXPECT_NEAR(tests::force_at(TwoLinkManipulator(), at).dot(at.v), 5.0 * 2.0 + 7.0 * (-3.0 - 2.0), 1e-14);
}

TEST(TwoLinkManipulator, PicturesAnElbowAndATipAtTheLengthsOfTheLinks) {
  const auto problem = uneven();
  const TwoRods rods(*problem);
  tests::RandomPoints random;
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Vector2d q = random.vector(2, -3.0, 3.0);
    auto named = tests::picture_at(*problem, {q, Eigen::Vector2d::Zero(), Eigen::Vector2d(3.0, 4.0)});
    const Eigen::Vector2d elbow(named["elbow_x"], named["elbow_y"]);
    const Eigen::Vector2d tip(named["tip_x"], named["tip_y"]);
    EXPECT_NEAR(elbow.norm(), rods.l1, 1e-14);
    EXPECT_NEAR((tip - elbow).norm(), rods.l2, 1e-14);
    // Centres lie halfway along the links.
    EXPECT_LT((rods.centres(q).head(2) - 0.5 * elbow).norm(), 1e-14);
    EXPECT_LT((rods.centres(q).tail(2) - 0.5 * (elbow + tip)).norm(), 1e-14);
    EXPECT_EQ(named["tau_1"], 3.0);
    EXPECT_EQ(named["tau_2"], 4.0);
  }
}

}  // namespace
}  // namespace dmocbench
