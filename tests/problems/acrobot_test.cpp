#include "problems/acrobot.hpp"

#include <gtest/gtest.h>

#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

/// The accelerations as the guide's program computes them; `lever` is l₂ there.
Eigen::Vector2d printed_acceleration(const Eigen::Vector2d& q, const Eigen::Vector2d& v, double u, double lever) {
  constexpr double g = 9.81;
  constexpr double b = 0.1;
  const double s2 = std::sin(q[1]);
  const double c2 = std::cos(q[1]);
  const double h11 = 1.0 / 3.0 + 1.0 + 1.0 + 2.0 * c2;
  const double h12 = 1.0 + c2;
  const double h22 = 1.0;
  const double weight = g * lever * std::sin(q[0] + q[1]);
  const double first = 2.0 * s2 * v[0] * v[1] + s2 * v[1] * v[1] - 1.5 * g * std::sin(q[0]) - weight - b * v[0];
  const double second = u - s2 * v[0] * v[0] - weight - b * v[1];
  const double determinant = h11 * h22 - h12 * h12;
  return {(h22 * first - h12 * second) / determinant, (-h12 * first + h11 * second) / determinant};
}

TEST(Acrobot, ObeysTheEquationsOfTheGuideAndWithThePhysicalLever) {
  Acrobot problem;
  tests::RandomPoints random;
  for (const bool physical : {false, true}) {
    problem.set_parameter("physical", physical ? 1.0 : 0.0);
    EquationsOfMotion motion{TracedProblem(problem)};
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::Vector2d q = random.vector(2, -3.0, 3.0);
      const Eigen::Vector2d v = random.vector(2, -5.0, 5.0);
      const double u = random.number(-10.0, 10.0);
      const Eigen::Vector2d expected = printed_acceleration(q, v, u, physical ? 1.0 : 2.0);
      EXPECT_LT((motion.acceleration(q, v, Eigen::VectorXd::Constant(1, u), 0.0) - expected).norm(),
                1e-11 * (1.0 + expected.norm()));
    }
  }
}

TEST(Acrobot, BeginsAndEndsInEquilibriumAtRest) { tests::expect_equilibrium_at_ends(Acrobot(), 1e-13); }

TEST(Acrobot, CannotBeAsCheapAsPublished) {
  // 2 · 9.81 (1.5 + 2) J are gained, of which every joule costs at least 4 · 0.1.
  Acrobot problem;
  const auto bound = [&] {
    Energy energy(problem);
    const auto at = [&](const BoundaryState& end) { return energy.energy(end.q, end.v, 0.0); };
    return 4.0 * problem.parameter("friction") * (at(problem.final_state()) - at(problem.initial_state()));
  };
  EXPECT_NEAR(bound(), 0.4 * 2.0 * 9.81 * 3.5, 1e-12);
  const auto optimum = tests::value_of(problem.card().reference);
  EXPECT_FALSE(optimum.published.empty());
  for (const PublishedOptimum& published : optimum.published) {
    EXPECT_LT(published.objective, bound()) << published.source;
  }
  problem.set_parameter("physical", 1.0);
  EXPECT_NEAR(bound(), 0.4 * 2.0 * 9.81 * 2.5, 1e-12);
  for (const double physical : {0.0, 1.0}) {
    problem.set_parameter("physical", physical);
    EXPECT_GT(tests::value_of(problem.card().reference).objective, bound());
  }
}

}  // namespace
}  // namespace dmocbench
