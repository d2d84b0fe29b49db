// The optimum against the same motion stated without least distances, by points at T/2; its orders and prices.
#include "problems/formation.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

double reference() { return tests::value_of(Formation().card().reference).objective; }

/// Of the satellites i and j.
double squared_distance(const Eigen::VectorXd& q, Eigen::Index i, Eigen::Index j) {
  return (q.segment(2 * i, 2) - q.segment(2 * j, 2)).squaredNorm();
}

class FormationThroughPoints : public testing::TestWithParam<Scheme> {};

// A convex problem: half planes at T/2, touched, in place of circles all along.
TEST_P(FormationThroughPoints, HasTheStatedOptimumAndKeepsTheDistances) {
  const Formation base;
  const double d = base.parameter("distance");
  const tests::Restated problem(base, [&](tests::Restated::Statement& s) {
    Bounds q = Bounds::none(6);
    q.lower[0] = q.upper[0] = -d;
    q.lower[2] = q.upper[2] = 0.0;
    q.lower[4] = q.upper[4] = d;
    s.interior = {{.relative_time = 0.5, .q = q}};
  });
  const Trajectory motion = tests::solve(problem, GetParam(), Grid::uniform(128), guessed_motion(problem)).trajectory;
  EXPECT_NEAR(motion.cost, reference(), 1e-11);
  const auto prices = motion.prices.q.row(64);
  EXPECT_LT(prices[0], -1.0);         // the first would come nearer from x < 0,
  EXPECT_GT(prices[4], 1.0);          // the third from x > 0,
  EXPECT_NEAR(prices[2], 0.0, 1e-8);  // and the second would stay
  for (Eigen::Index k = 0; k <= motion.intervals(); ++k) {
    const Eigen::VectorXd q = motion.q.row(k);
    EXPECT_GE(squared_distance(q, 0, 1), d * d - 1e-10);
    EXPECT_GE(squared_distance(q, 1, 2), d * d - 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FormationThroughPoints,
                         testing::Values(Scheme{"dmoc", 4}, Scheme{"tangent", 4}, Scheme{"hamiltonian", 4, "lobatto"}),
                         [](const auto& instance) { return instance.param.method; });

class FormationBy : public testing::TestWithParam<Scheme> {
 protected:
  static Trajectory solved(Eigen::Index intervals, double distance) {
    Formation problem;
    problem.set_parameter("distance", distance);
    return tests::solve(problem, GetParam(), Grid::uniform(intervals), guessed_motion(problem)).trajectory;
  }
};

// Between the stages next to T/2 the satellites may come nearer by O(h²), whatever the tableau.
TEST_P(FormationBy, TendsToTheStatedOptimumByOrderTwo) {
  const double coarse = solved(64, 0.5).cost - reference();
  const double fine = solved(128, 0.5).cost - reference();
  EXPECT_LT(std::abs(fine), 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05);
}

TEST_P(FormationBy, PricesOfDistancesAreTheSlopeOfTheLeastCost) {
  constexpr double step = 1e-3;
  const Trajectory motion = solved(16, 0.5);
  double price = 0.0;  // of d² for all pairs
  for (Eigen::Index row = 0; row < motion.prices.path.rows(); ++row) {
    const Eigen::Index s = motion.stages();
    price += motion.step(row / s) * motion.tableau.b[row % s] * motion.prices.path.row(row).sum();
  }
  // The constraint is |q_i - q_j|² - d² >= 0.
  const double slope = (solved(16, 0.5 + step).cost - solved(16, 0.5 - step).cost) / (2.0 * step);
  EXPECT_GT(price, 1.0);
  EXPECT_NEAR(2.0 * 0.5 * price, slope, 1e-4 * slope);
}

INSTANTIATE_TEST_SUITE_P(All, FormationBy,
                         testing::Values(Scheme{"dmoc", 1}, Scheme{"dmoc", 2}, Scheme{"hamiltonian", 1},
                                         Scheme{"hamiltonian", 2}, Scheme{"tangent", 1}, Scheme{"tangent", 2}),
                         tests::by_label);

}  // namespace
}  // namespace dmocbench
