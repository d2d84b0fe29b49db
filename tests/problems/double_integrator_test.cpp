#include "problems/double_integrator.hpp"

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

TEST(DoubleIntegrator, IsPushedAndNothingElse) {
  const DoubleIntegrator problem;
  EquationsOfMotion motion{TracedProblem(problem)};
  const auto at = [](double value) { return Eigen::VectorXd::Constant(1, value); };
  EXPECT_EQ(motion.acceleration(at(3.0), at(-2.0), at(0.7), 0.5)[0], 0.7);
}

TEST(DoubleIntegrator, HasTheOptimumOfItsOwnPolynomial) {
  // q = d(3τ² - 2τ³): u = 6d/T²(1 - 2τ), and ½∫u² by Simpson's rule, exact for the square of a line.
  DoubleIntegrator problem;
  problem.set_parameter("distance", 2.5);
  problem.set_parameter("horizon", 3.0);
  const double push = 6.0 * 2.5 / 9.0;
  const double cost = 3.0 / 6.0 * 0.5 * (push * push + 4.0 * 0.0 + push * push);
  EXPECT_NEAR(tests::value_of(problem.card().reference).objective, cost, 1e-14);
  EXPECT_EQ(problem.final_state().q[0], 2.5);
  EXPECT_EQ(problem.horizon(), 3.0);
}

TEST(DoubleIntegrator, ComparesWithPublishedValuesForTheirDataOnly) {
  DoubleIntegrator problem;
  EXPECT_EQ(tests::value_of(problem.card().reference).published.size(), 1U);
  EXPECT_EQ(tests::value_of(problem.card().reference).objective, 6.0);
  problem.set_parameter("distance", 2.0);
  EXPECT_TRUE(tests::value_of(problem.card().reference).published.empty());
}

}  // namespace
}  // namespace dmocbench
