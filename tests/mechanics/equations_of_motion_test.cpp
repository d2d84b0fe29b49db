#include "methods/mechanics/equations_of_motion.hpp"

#include <cmath>
#include <map>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;

TEST(EquationsOfMotion, OfTheOrbitAreKeplersWithThrust) {
  EquationsOfMotion motion{TracedProblem(*make_problem("orbital_transfer"))};
  RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd q = random.vector(2, 0.5, 2.0);
    const Eigen::VectorXd v = random.vector(2);
    const Eigen::VectorXd u = random.vector(1);
    // r̈ = rφ̇² - 1/r², φ̈ = (u - 2ṙφ̇)/r.
    const Eigen::Vector2d expected(q[0] * v[1] * v[1] - 1.0 / (q[0] * q[0]), (u[0] - 2.0 * v[0] * v[1]) / q[0]);
    EXPECT_LT((motion.acceleration(q, v, u, 0.0) - expected).norm(), 1e-13);
  }
}

TEST(EquationsOfMotion, OfTheTwoLinkArmAreThoseOfTwoJointedRods) {
  const auto problem = make_problem("two_link_manipulator");
  for (const auto& [name, value] : std::map<std::string, double>{{"mass_1", 1.3},
                                                                 {"mass_2", 0.7},
                                                                 {"length_1", 0.9},
                                                                 {"length_2", 1.2},
                                                                 {"inertia_1", 0.11},
                                                                 {"inertia_2", 0.05}}) {
    problem->set_parameter(name, value);
  }
  constexpr double m1 = 1.3;
  constexpr double m2 = 0.7;
  constexpr double l1 = 0.9;
  constexpr double l2 = 1.2;
  constexpr double g = 9.81;
  EquationsOfMotion motion{TracedProblem(*problem)};
  RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd q = random.vector(2, -3.0, 3.0);
    const Eigen::VectorXd v = random.vector(2, -4.0, 4.0);
    const Eigen::VectorXd u = random.vector(2, -20.0, 20.0);
    const double c = 0.5 * m2 * l1 * l2 * std::cos(q[0] - q[1]);
    const double s = 0.5 * m2 * l1 * l2 * std::sin(q[0] - q[1]);
    Eigen::Matrix2d mass;
    mass << 0.25 * m1 * l1 * l1 + m2 * l1 * l1 + 0.11, c, c, 0.25 * m2 * l2 * l2 + 0.05;
    const Eigen::Vector2d right(u[0] - u[1] - s * v[1] * v[1] - (0.5 * m1 + m2) * g * l1 * std::cos(q[0]),
                                u[1] + s * v[0] * v[0] - 0.5 * m2 * g * l2 * std::cos(q[1]));
    const Eigen::Vector2d expected = mass.inverse() * right;
    EXPECT_LT((motion.acceleration(q, v, u, 0.0) - expected).norm(), 1e-11);
  }
}

/// L = ½ m(t) v² + a(t) q v with m = 1 + t², a = sin t: d/dt(m v + a q) = a v gives v̇ = (u - ṁ v - ȧ q)/m.
class GrowingMass final : public tests::SmallProblem {
 public:
  GrowingMass() : SmallProblem("growing_mass", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * (1.0 + x.t * x.t) * x.v[0] * x.v[0] + sin(x.t) * x.q[0] * x.v[0];
  }
};

TEST(EquationsOfMotion, CountTheExplicitChangeOfMomentumWithTime) {
  EquationsOfMotion motion{TracedProblem(GrowingMass())};
  const auto number = [](double x) { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, x)); };
  for (const double t : {0.0, 0.4, 1.7}) {
    const double expected = (0.3 - 2.0 * t * 0.9 - std::cos(t) * 0.6) / (1.0 + t * t);
    EXPECT_NEAR(motion.acceleration(number(0.6), number(0.9), number(0.3), t)[0], expected, 1e-15);
  }
}

TEST(EquationsOfMotion, RefuseASingularMass) {
  /// Polar coordinates at r = 0.
  EquationsOfMotion motion{TracedProblem(*make_problem("orbital_transfer"))};
  const Eigen::Vector2d v(0.0, 1.0);
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(1);
  tests::expect_error_naming({"not regular", "L_vv"},
                             [&] { static_cast<void>(motion.acceleration(Eigen::Vector2d(0.0, 1.0), v, u, 0.0)); });
}

}  // namespace
}  // namespace dmocbench
