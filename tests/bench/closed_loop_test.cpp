#include <gtest/gtest.h>

#include "bench/experiments/closed_loop/plant.hpp"
#include "bench/experiments/closed_loop/replanner.hpp"
#include "problems/registry.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

class ClosedLoop : public testing::Test {
 protected:
  Replanner replanner(int intervals) {
    const Case the_case{
        .problem = problem_, .method = "dmoc", .solver = "interior_point", .grid = Grid::uniform(intervals)};
    return {the_case, tests::common_start(*problem_), {}};
  }
  std::shared_ptr<Problem> problem_ = make_problem("two_link_manipulator");
};

TEST_F(ClosedLoop, DisturbanceMovesAMassAsAForceDoes) {
  problem_ = make_problem("double_integrator");
  Plant plant(*problem_);
  Replanner plans = replanner(16);
  const double force = 0.3;
  for (const double from : {0.0, 0.4}) {  // in two samples, whose ends are no nodes
    plant.follow(plans.current(), from, from == 0.0 ? 0.4 : 1.0, Eigen::VectorXd::Constant(1, force));
  }
  const BoundaryState disturbed = plant.state();
  const double cost = plant.cost(1.0);
  plant.begin();
  plant.follow(plans.current(), 0.0, 1.0, Eigen::VectorXd::Zero(1));
  EXPECT_NEAR(disturbed.q[0] - plant.state().q[0], 0.5 * force, 1e-9);
  EXPECT_NEAR(disturbed.v[0] - plant.state().v[0], force, 1e-9);
  EXPECT_NEAR(plant.momentum(plant.state()), plant.state().v[0], 1e-14);
  EXPECT_NEAR(plant.cost(1.0), plans.current().cost, 1e-9);
  EXPECT_NEAR(cost, plans.current().cost, 1e-9) << "disturbances are not controls and cost nothing";
}

TEST_F(ClosedLoop, ViolationIsTheExcessOverTheDistanceOfTheBounds) {
  problem_ = make_problem("double_integrator");
  const Replanner plans = replanner(16);
  const double peak = plans.current().stage_u.cwiseAbs().maxCoeff();
  problem_->set_parameter("largest_force", 0.9 * peak);
  Plant plant(*problem_);
  plant.follow(plans.current(), 0.0, 1.0, Eigen::VectorXd::Zero(1));
  EXPECT_NEAR(plant.violation(), 0.1 * peak / (1.8 * peak), 1e-12);
  plant.begin();
  EXPECT_EQ(plant.violation(), 0.0);
}

TEST_F(ClosedLoop, PlanFromAStateOnTheOptimumIsTheRestOfIt) {
  problem_ = make_problem("double_integrator");
  Replanner plans = replanner(64);
  const double t = 0.25;
  const MotionPoint on_way = problem_->optimum(t)->motion;
  plans.plan({on_way.q, on_way.v}, t);
  EXPECT_EQ(plans.made_at(), t);
  EXPECT_EQ(plans.failed(), 0);
  const Trajectory& rest = plans.current();
  for (Eigen::Index k = 0; k <= rest.intervals(); ++k) {
    EXPECT_NEAR(rest.q(k, 0), problem_->optimum(t + rest.node_times[k])->motion.q[0], 1e-4);
  }
  plans.begin();
  EXPECT_EQ(plans.made_at(), 0.0);
  EXPECT_EQ(plans.plans(), 1);
}

/// The plant's final distance with plans at `samples` times.
double final_distance(Plant& plant, Replanner& plans, int samples) {
  const double sample = 1.0 / samples;
  plant.begin();
  plans.begin();
  for (int k = 0; k < samples; ++k) {
    const double t = k * sample;
    if (k > 0) plans.plan(plant.state(), t);
    plant.follow(plans.current(), t - plans.made_at(), t - plans.made_at() + sample, Eigen::VectorXd::Zero(2));
  }
  return (plant.state().q - plans.current().q.bottomRows(1).transpose()).norm();
}

TEST_F(ClosedLoop, EndsNearerToTheFinalStateTheMoreOftenItPlans) {
  Plant plant(*problem_);
  Replanner plans = replanner(16);
  const double open = final_distance(plant, plans, 1);
  const double twice = final_distance(plant, plans, 2);
  const double often = final_distance(plant, plans, 8);
  EXPECT_LT(twice, 0.5 * open);
  EXPECT_LT(often, 0.5 * twice);
  EXPECT_EQ(plans.plans(), 8);
}

TEST_F(ClosedLoop, KeepsThePlanWhereASolveFails) {
  problem_ = make_problem("double_integrator");
  problem_->set_parameter("largest_force", 5.5);
  Replanner plans = replanner(16);
  plans.plan({.q = Eigen::VectorXd::Constant(1, -50.0), .v = Eigen::VectorXd::Zero(1)}, 0.5);
  EXPECT_EQ(plans.failed(), 1);
  EXPECT_EQ(plans.made_at(), 0.0);
  EXPECT_EQ(plans.plans(), 2);
}

}  // namespace
}  // namespace dmocbench
