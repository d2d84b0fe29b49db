// Problems restated in redundant coordinates: the same L, work, ends and cost as in minimal ones.
#include <cmath>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "problems/cart_pole_cartesian.hpp"
#include "problems/link_chain_maximal.hpp"
#include "problems/spherical_pendulum_cartesian.hpp"
#include "problems/two_link_maximal.hpp"

namespace dmocbench {
namespace {

template <class Redundant>
class RedundantStatements : public testing::Test {};

using Statements = testing::Types<SphericalPendulumCartesian, CartPoleCartesian, TwoLinkMaximal, LinkChainMaximal>;
TYPED_TEST_SUITE(RedundantStatements, Statements);

/// Formulas of both statements at a point (θ, θ̇, u), which are to be equal, one after the other.
template <class Redundant>
std::vector<std::pair<Expression, Expression>> formulas(const Redundant& problem, const ControlledState& x) {
  const auto minimal = problem.minimal();
  const ExpressionVector q = problem.embedding(x.q);
  const ExpressionMatrix by_theta = jacobian(q, x.q);
  const ControlledState lifted{q, by_theta * x.v, x.u, x.t};
  std::vector<std::pair<Expression, Expression>> pairs;
  pairs.emplace_back(problem.lagrangian(lifted.state()), minimal.lagrangian(x.state()));
  pairs.emplace_back(problem.running_cost(lifted), minimal.running_cost(x));
  const ExpressionVector work = by_theta.transpose() * problem.force(lifted);
  const ExpressionVector minimal_work = minimal.force(x);
  for (Eigen::Index i = 0; i < work.size(); ++i) pairs.emplace_back(work[i], minimal_work[i]);
  for (const Expression& g : problem.constraints(q)) pairs.emplace_back(g, 0.0);
  return pairs;
}

TYPED_TEST(RedundantStatements, HaveTheLagrangianTheWorkAndTheCostOfTheMinimalOne) {
  const TypeParam problem;
  const auto minimal = problem.minimal();
  const Eigen::Index n = minimal.configuration_size();
  const Eigen::Index m = minimal.control_size();
  InputCounter inputs;
  const ControlledState x{inputs.take(n), inputs.take(n), inputs.take(m), inputs.take()};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> between(0.2, 1.2);
  for (int sample = 0; sample < 10; ++sample) {
    std::vector<double> numbers(static_cast<std::size_t>(2 * n + m + 1));
    for (double& number : numbers) number = between(random);
    for (const auto& [a, b] : formulas(problem, x)) {
      const auto value = [&](const Expression& formula) {
        return replay<double>(Schedule(std::span(&formula, 1)), std::span<const double>(numbers)).front();
      };
      EXPECT_NEAR(value(a), value(b), 1e-13 * (1.0 + std::abs(value(b))));
    }
  }
}

TYPED_TEST(RedundantStatements, HaveTheEndsAndTheHorizonOfTheMinimalOne) {
  const TypeParam problem;
  const auto minimal = problem.minimal();
  EXPECT_EQ(problem.horizon(), minimal.horizon());
  const BoundaryState last = problem.lifted(minimal.final_state());
  EXPECT_EQ(problem.final_state().q, last.q);
  EXPECT_EQ(problem.final_state().v, last.v);
  EXPECT_EQ(problem.guess(0.0).q, problem.initial_state().q);
  EXPECT_GE(problem.card().reference->digits, 10);
}

}  // namespace
}  // namespace dmocbench
