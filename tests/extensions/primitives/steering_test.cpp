#include "methods/extensions/primitives/steering.hpp"

#include <gtest/gtest.h>

#include "methods/extensions/primitives/meeting_trees.hpp"
#include "methods/extensions/primitives/solve_primitives.hpp"
#include "problems/registry.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

Eigen::MatrixXd row_of(const BoundaryState& state) {
  Eigen::MatrixXd row(1, 2 * state.q.size());
  row << state.q.transpose(), state.v.transpose();
  return row;
}

BoundaryState state_of(const Eigen::MatrixXd& row) {
  const Eigen::Index n = row.cols() / 2;
  return {row.leftCols(n).transpose(), row.rightCols(n).transpose()};
}

Eigen::MatrixXd random_states(tests::RandomPoints& random, Eigen::Index count, Eigen::Index entries) {
  return Eigen::MatrixXd::NullaryExpr(count, entries, [&] { return random.number(-2.0, 2.0); });
}

/// One primitive of so many intervals between two states, by DMOC.
PrimitiveLibrary solved_between(const Problem& problem, const BoundaryState& first, const BoundaryState& last, double h,
                                int intervals) {
  PrimitiveLibrary library = PrimitiveLibrary::of(problem, h * intervals, intervals);
  library.states = {first, last};
  PrimitiveRequest request{.first = 0, .last = 1, .displacement = Displacement::identity(first.q.size())};
  PrimitiveOptions options;
  options.tolerance = 1e-11;
  solve_primitives(problem, {request}, library, options);
  return library;
}

TEST(DiscreteFlow, UndoesItselfBackwards) {
  const auto problem = make_problem("acrobot");
  tests::RandomPoints random;
  const Eigen::MatrixXd states = random_states(random, 20, 4);
  const Eigen::MatrixXd controls = random_states(random, 20, 1);
  Eigen::MatrixXd moved = states;
  Eigen::VectorXd costs = Eigen::VectorXd::Zero(20);
  DiscreteFlow(*problem, 0.01).advance(moved, controls, costs);
  EXPECT_GT((moved - states).norm(), 0.1);
  DiscreteFlow(*problem, -0.01).advance(moved, controls, costs);
  EXPECT_LT((moved - states).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_LT(costs.lpNorm<Eigen::Infinity>(), 1e-14);
}

TEST(DiscreteFlow, IsTheMotionThatDmocSolvesForBetweenItsEnds) {
  // With as many controls as velocities two intervals are determined by their ends.
  const auto problem = make_problem("two_link_manipulator");
  const double h = 0.02;
  const DiscreteFlow flow(*problem, h);
  tests::RandomPoints random;
  const Eigen::MatrixXd first = random_states(random, 1, 4);
  const Eigen::MatrixXd controls = 5.0 * random_states(random, 2, 2);
  Eigen::MatrixXd last = first;
  Eigen::VectorXd cost = Eigen::VectorXd::Zero(1);
  for (Eigen::Index k = 0; k < 2; ++k) flow.advance(last, controls.row(k), cost);
  const PrimitiveLibrary library = solved_between(*problem, state_of(first), state_of(last), h, 2);
  ASSERT_EQ(library.primitives.size(), 1U);
  EXPECT_LT((library.primitives[0].u - controls).lpNorm<Eigen::Infinity>(), 1e-5);
  EXPECT_NEAR(library.primitives[0].cost, cost[0], 1e-5 * cost[0]);
}

TEST(DiscreteFlow, HasTheDerivativesOfItsDifferences) {
  const auto problem = make_problem("cart_pole");
  const DiscreteFlow flow(*problem, 0.01);
  tests::RandomPoints random;
  const Eigen::MatrixXd state = random_states(random, 1, 4);
  const Eigen::MatrixXd control = random_states(random, 1, 1);
  const Eigen::MatrixXd derivatives = flow.derivatives(state, control).reshaped(4, 5);
  constexpr double step = 1e-5;
  for (Eigen::Index i = 0; i < 5; ++i) {
    Eigen::MatrixXd ends(2, 4);
    for (const int side : {0, 1}) {
      Eigen::MatrixXd moved = state;
      Eigen::MatrixXd moved_control = control;
      (i < 4 ? moved(0, i) : moved_control(0, 0)) += side == 0 ? -step : step;
      Eigen::VectorXd cost = Eigen::VectorXd::Zero(1);
      flow.advance(moved, moved_control, cost);
      ends.row(side) = moved;
    }
    const Eigen::VectorXd difference = (ends.row(1) - ends.row(0)).transpose() / (2.0 * step);
    EXPECT_LT((difference - derivatives.col(i)).norm(), 1e-3 * (1.0 + difference.norm())) << i;
  }
}

TEST(Steering, IsTheOptimumOfALinearSystem) {
  const auto problem = make_problem("double_integrator");
  const double h = 0.05;
  constexpr int intervals = 12;
  const DiscreteFlow flow(*problem, h);
  const BoundaryState first{Eigen::VectorXd::Constant(1, 0.2), Eigen::VectorXd::Constant(1, -0.4)};
  const BoundaryState last{Eigen::VectorXd::Constant(1, 0.3), Eigen::VectorXd::Constant(1, 0.7)};
  const Steering steering = steerings(flow, row_of(first), Eigen::VectorXd::Zero(1), intervals).front();
  const Eigen::VectorXd miss = row_of(last).transpose() - steering.end();
  const Eigen::MatrixXd controls = steering.deviations(miss);
  Eigen::MatrixXd end = row_of(first);
  Eigen::VectorXd cost = Eigen::VectorXd::Zero(1);
  for (Eigen::Index k = 0; k < intervals; ++k) flow.advance(end, controls.row(k), cost);
  EXPECT_LT((end - row_of(last)).norm(), 1e-10);
  const PrimitiveLibrary library = solved_between(*problem, first, last, h, intervals);
  ASSERT_EQ(library.primitives.size(), 1U);
  EXPECT_LT((library.primitives[0].u - controls).norm(), 1e-7);
  EXPECT_NEAR(cost[0], library.primitives[0].cost, 1e-9);
  EXPECT_NEAR(steering.effort(miss), 0.5 * h * controls.squaredNorm(), 1e-10);
}

TEST(MotionTree, KeepsTheCheapestStateOfACellAndTellsItsMotion) {
  const auto problem = make_problem("double_integrator");
  const DiscreteFlow flow(*problem, 0.1);
  const LatticeOptions options{
      .intervals_per_step = 2, .controls = Eigen::Vector3d(-3.0, 0.0, 3.0), .cell = Eigen::Vector2d(0.3, 0.3)};
  const auto tree = grow_tree(flow, BoundaryState::at_rest(Eigen::VectorXd::Zero(1)), options, {}, 3);
  ASSERT_EQ(tree.size(), 4U);
  for (std::size_t layer = 1; layer < tree.size(); ++layer) {
    for (std::size_t i = 0; i < tree[layer].parents.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      Eigen::MatrixXd state = tree[layer - 1].states.row(tree[layer].parents[i]);
      Eigen::VectorXd cost = tree[layer - 1].costs.segment(tree[layer].parents[i], 1);
      for (int k = 0; k < 2; ++k) flow.advance(state, options.controls.row(tree[layer].controls[i]), cost);
      EXPECT_LT((state - tree[layer].states.row(row)).norm(), 1e-12);
      EXPECT_NEAR(cost[0], tree[layer].costs[row], 1e-12);
      // Whatever its parents lead to in its cell costs as much at least.
      for (Eigen::Index parent = 0; parent < tree[layer - 1].states.rows(); ++parent) {
        for (Eigen::Index choice = 0; choice < 3; ++choice) {
          Eigen::MatrixXd other = tree[layer - 1].states.row(parent);
          Eigen::VectorXd other_cost = tree[layer - 1].costs.segment(parent, 1);
          for (int k = 0; k < 2; ++k) flow.advance(other, options.controls.row(choice), other_cost);
          const bool is_same_cell = ((other / 0.3).array().round() == (state / 0.3).array().round()).all();
          EXPECT_TRUE(!is_same_cell || other_cost[0] >= cost[0] - 1e-12);
        }
      }
    }
  }
}

}  // namespace
}  // namespace dmocbench
