// Slopes of log(error) over log(step), bounded from both sides.
#include <map>
#include <string>
#include <vector>

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

/// By quantities.
using Slopes = std::map<std::string, double>;

using GridMaker = Grid (*)(long long);

/// Slopes over the given grids against a reference of the same method on the finest one.
Slopes slopes(const Problem& problem, const Scheme& scheme, const std::vector<long long>& grids,
              long long reference_intervals, GridMaker make_grid) {
  const Motion& start = tests::common_start(problem);
  constexpr double tolerance = 1e-11;
  const Trajectory reference =
      tests::solve(problem, scheme, make_grid(reference_intervals), start, tolerance).trajectory;
  std::map<std::string, std::vector<GridError>> errors;
  for (const long long intervals : grids) {
    const Trajectory coarse = tests::solve(problem, scheme, make_grid(intervals), start, tolerance).trajectory;
    const TrajectoryError error = trajectory_error(coarse, reference);
    const double step = 1.0 / static_cast<double>(intervals);
    errors["state"].push_back({step, error.state});
    errors["momentum"].push_back({step, error.momentum});
    errors["control"].push_back({step, error.control});
    errors["costate"].push_back({step, tests::value_of(error.costate)});
  }
  Slopes slopes;
  for (const auto& [quantity, of_grids] : errors) slopes[quantity] = fit_order(of_grids)->order;
  return slopes;
}

void expect_order(const Slopes& slopes, const std::vector<std::string>& quantities, double order, double margin) {
  for (const std::string& quantity : quantities) EXPECT_NEAR(slopes.at(quantity), order, margin) << quantity;
}

const std::vector<std::string> all_quantities{"state", "momentum", "control", "costate"};

class Convergence : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  std::unique_ptr<Problem> problem_ = make_problem(std::get<0>(GetParam()));
  std::string method_ = std::get<1>(GetParam());
};

TEST_P(Convergence, OfTheMidpointRuleIsOfOrderTwo) {
  const Slopes measured = slopes(*problem_, {method_, 1}, {32, 64, 128, 256}, 1024, &Grid::uniform);
  expect_order(measured, all_quantities, 2.0, 0.1);
}

TEST_P(Convergence, OnASmoothlyGradedGridIsOfOrderTwoAsWell) {
  const auto graded = [](long long intervals) { return tests::graded_grid(intervals); };
  const Slopes measured = slopes(*problem_, {method_, 1}, {64, 128, 256}, 1024, graded);
  expect_order(measured, {"state", "momentum", "control"}, 2.0, 0.15);
}

TEST(ConvergenceOfSecondOrder, OfTheMidpointRuleIsOfOrderTwo) {
  for (const std::string& name : paper_problem_names()) {
    const Slopes measured = slopes(*make_problem(name), {"second_order", 1}, {96, 128, 192, 256}, 1152, &Grid::uniform);
    expect_order(measured, all_quantities, 2.0, 0.1);
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
  expect_order(measured, {"state", "momentum", "costate"}, 4.0, 0.25);
}

TEST_P(HighOrder, OfGaussThreeIsSixAtTheNodes) {
  const auto problem = make_problem("two_link_manipulator");
  const Slopes measured = slopes(*problem, {GetParam(), 3}, {64, 96, 128}, 384, &Grid::uniform);
  expect_order(measured, {"state", "momentum"}, 6.0, 0.5);
}

TEST_P(HighOrder, HoldsForALagrangianThatDependsOnTime) {
  const tests::MovingFrame problem;
  expect_order(slopes(problem, {GetParam(), 2}, {8, 16, 32}, 128, &Grid::uniform), {"state", "costate"}, 4.0, 0.25);
  expect_order(slopes(problem, {GetParam(), 3}, {4, 8, 16}, 64, &Grid::uniform), {"state"}, 6.0, 0.5);
}

INSTANTIATE_TEST_SUITE_P(All, HighOrder, testing::ValuesIn(paper_families()),
                         [](const auto& instance) { return instance.param; });
INSTANTIATE_TEST_SUITE_P(OfSecondOrder, HighOrder, testing::Values("second_order"));

}  // namespace
}  // namespace dmocbench
