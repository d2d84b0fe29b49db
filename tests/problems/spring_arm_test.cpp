#include "problems/spring_arm.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

class SpringArmBy : public testing::TestWithParam<Scheme> {
 protected:
  static Trajectory solved(const Problem& problem, Eigen::Index intervals) {
    return tests::solve(problem, GetParam(), Grid::uniform(intervals), guessed_motion(problem)).trajectory;
  }
};

TEST_P(SpringArmBy, SwingsThroughByItselfWithoutDamping) {
  SpringArm problem;
  problem.set_parameter("damping", 0.0);
  const auto error_of = [&](Eigen::Index intervals) {
    const Trajectory motion = solved(problem, intervals);
    EXPECT_LT(motion.stage_u.lpNorm<Eigen::Infinity>(), 1e-5);
    return motion.unknowns[0] - std::numbers::pi * std::numbers::pi;
  };
  // The discrete arm swings with a frequency of its own.
  const int order = GetParam().tableau().order;
  const Eigen::Index coarse = order == 2 ? 32 : 4;
  EXPECT_NEAR(std::log2(error_of(coarse) / error_of(2 * coarse)), order, 0.15);
}

TEST_P(SpringArmBy, FindsTheStiffnessOfLeastCost) {
  const SpringArm problem;
  const Trajectory best = solved(problem, 32);
  const double stiffness = best.unknowns[0];
  const auto cost_with = [&](double k) {
    class Given final : public tests::SmallProblem {
     public:
      Given(const Problem& base, double k)
          : SmallProblem("given", base.initial_state(), base.final_state(), base.horizon(), 1,
                         {{"stiffness", k, "N m", "of the spring"}, {"damping", 0.5, "N m s", "of the joint"}}),
            base_(base) {}
      [[nodiscard]] Expression lagrangian(const State& x) const override {
        return 0.5 * x.v[0] * x.v[0] - 0.5 * varying("stiffness") * x.q[0] * x.q[0];
      }
      [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return base_.force(x); }
      [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return base_.running_cost(x); }

     private:
      const Problem& base_;
    };
    return solved(Given(problem, k), 32).cost;
  };
  EXPECT_NEAR(cost_with(stiffness), best.cost, 1e-9);
  EXPECT_GT(cost_with(stiffness + 0.2), best.cost + 1e-6);
  EXPECT_GT(cost_with(stiffness - 0.2), best.cost + 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, SpringArmBy, testing::ValuesIn(tests::all_schemes(2)), tests::by_label);

}  // namespace
}  // namespace dmocbench
