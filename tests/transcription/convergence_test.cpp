// Slopes of log(error) over log(step), bounded from both sides.

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

struct Slopes {
  double state;
  double momentum;
  double control;
  double costate;
};

using GridMaker = Grid (*)(long long);

/// Slopes over the given grids against a reference of the same method on the finest one.
Slopes slopes(const Problem& problem, const Scheme& scheme, const std::vector<long long>& grids,
              long long reference_intervals, GridMaker make_grid) {
  const Motion& start = tests::common_start(problem);
  constexpr double tolerance = 1e-11;
  const Trajectory reference =
      tests::solve(problem, scheme, make_grid(reference_intervals), start, tolerance).trajectory;
  std::vector<GridError> state;
  std::vector<GridError> momentum;
  std::vector<GridError> control;
  std::vector<GridError> costate;
  for (const long long intervals : grids) {
    const Trajectory coarse = tests::solve(problem, scheme, make_grid(intervals), start, tolerance).trajectory;
    const TrajectoryError error = trajectory_error(coarse, reference);
    const double step = 1.0 / static_cast<double>(intervals);
    state.push_back({step, error.state});
    momentum.push_back({step, error.momentum});
    control.push_back({step, error.control});
    costate.push_back({step, tests::value_of(error.costate)});
  }
  const auto slope = [](const std::vector<GridError>& errors) { return fit_order(errors)->order; };
  return {slope(state), slope(momentum), slope(control), slope(costate)};
}

void expect_order(double slope, double order, double margin, const std::string& what) {
  EXPECT_GT(slope, order - margin) << what;
  EXPECT_LT(slope, order + margin) << what;
}

class Convergence : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  std::unique_ptr<Problem> problem_ = make_problem(std::get<0>(GetParam()));
  std::string method_ = std::get<1>(GetParam());
};

TEST_P(Convergence, OfTheMidpointRuleIsOfOrderTwo) {
  const Slopes measured = slopes(*problem_, {method_, 1}, {32, 64, 128, 256}, 1024, &Grid::uniform);
  expect_order(measured.state, 2.0, 0.1, "state");
  expect_order(measured.momentum, 2.0, 0.1, "momentum");
  expect_order(measured.control, 2.0, 0.1, "control");
  expect_order(measured.costate, 2.0, 0.1, "costate");
}

TEST_P(Convergence, OnASmoothlyGradedGridIsOfOrderTwoAsWell) {
  const auto graded = [](long long intervals) { return tests::graded_grid(intervals); };
  const Slopes measured = slopes(*problem_, {method_, 1}, {64, 128, 256}, 1024, graded);
  expect_order(measured.state, 2.0, 0.15, "state");
  expect_order(measured.momentum, 2.0, 0.15, "momentum");
  expect_order(measured.control, 2.0, 0.15, "control");
}

TEST(ConvergenceOfSecondOrder, OfTheMidpointRuleIsOfOrderTwo) {
  for (const std::string& name : paper_problem_names()) {
    const Slopes measured = slopes(*make_problem(name), {"second_order", 1}, {96, 128, 192, 256}, 1152, &Grid::uniform);
    expect_order(measured.state, 2.0, 0.1, "state");
    expect_order(measured.momentum, 2.0, 0.1, "momentum");
    expect_order(measured.control, 2.0, 0.1, "control");
    expect_order(measured.costate, 2.0, 0.1, "costate");
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Convergence, testing::Combine(testing::ValuesIn(paper_problem_names()), testing::ValuesIn(paper_families())),
    [](const auto& instance) { return std::get<0>(instance.param) + "_" + std::get<1>(instance.param); });

class HighOrder : public testing::TestWithParam<std::string> {};

TEST_P(HighOrder, OfGaussTwoIsFourAtTheNodes) {
  // One control per interval instead of one per stage would pull all of them to order 2.
  const auto problem = make_problem("two_link_manipulator");
  const Slopes measured = slopes(*problem, {GetParam(), 2}, {64, 96, 128}, 512, &Grid::uniform);
  expect_order(measured.state, 4.0, 0.25, "state");
  expect_order(measured.momentum, 4.0, 0.25, "momentum");
  expect_order(measured.costate, 4.0, 0.25, "costate");
}

TEST_P(HighOrder, OfGaussThreeIsSixAtTheNodes) {
  const auto problem = make_problem("two_link_manipulator");
  const Slopes measured = slopes(*problem, {GetParam(), 3}, {64, 96, 128}, 384, &Grid::uniform);
  expect_order(measured.state, 6.0, 0.5, "state");
  expect_order(measured.momentum, 6.0, 0.5, "momentum");
}

TEST_P(HighOrder, HoldsForALagrangianThatDependsOnTime) {
  const tests::MovingFrame problem;
  const Slopes two = slopes(problem, {GetParam(), 2}, {8, 16, 32}, 128, &Grid::uniform);
  expect_order(two.state, 4.0, 0.25, "state, s = 2");
  expect_order(two.costate, 4.0, 0.25, "costate, s = 2");
  const Slopes three = slopes(problem, {GetParam(), 3}, {4, 8, 16}, 64, &Grid::uniform);
  expect_order(three.state, 6.0, 0.5, "state, s = 3");
}

INSTANTIATE_TEST_SUITE_P(All, HighOrder, testing::ValuesIn(paper_families()),
                         [](const auto& instance) { return instance.param; });
INSTANTIATE_TEST_SUITE_P(OfSecondOrder, HighOrder, testing::Values("second_order"));

}  // namespace
}  // namespace dmocbench
