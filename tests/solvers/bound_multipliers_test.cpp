// What bounds cost: the prices of a motion against differences of re-solved optima.
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/wider_problems.hpp"

namespace dmocbench {
namespace {

using tests::Restated;
using tests::Scheme;
using Statement = Restated::Statement;

/// All schemes, those in which neighbours share a control among them.
std::vector<Scheme> every_scheme() {
  std::vector<Scheme> schemes = tests::all_schemes();
  for (const Scheme& scheme : tests::schemes_with_shared_controls()) schemes.push_back(scheme);
  return schemes;
}

class BoundMultipliersOf : public testing::TestWithParam<Scheme> {
 protected:
  static constexpr Eigen::Index intervals = 12;
  static constexpr double step = 1e-3;

  /// A problem on steps that differ.
  static Trajectory solved(const Problem& problem) {
    const auto program = tests::transcribe(problem, GetParam(), tests::graded_grid(intervals));
    SolverOptions options;
    options.tolerance = 1e-11;
    const Solution solution =
        make_solver("interior_point", options)->solve(*program, sample(*program, guessed_motion(problem)));
    EXPECT_EQ(solution.status, Status::solved) << solution.message;
    return read_trajectory(*program, solution.primal, solution.multipliers);
  }
  /// The double integrator with bounds as `state` states them.
  static Trajectory solved(const std::function<void(Statement&)>& state) {
    const tests::DoubleIntegrator base;
    return solved(Restated(base, state));
  }
  /// d least cost / d bound.
  static double slope(const std::function<Trajectory(double)>& solved_with, double at) {
    return (solved_with(at + step).cost - solved_with(at - step).cost) / (2.0 * step);
  }
  /// The same of bounds that `state` states for the value of a number.
  static double slope(const std::function<void(Statement&, double)>& state, double at) {
    return slope([&](double value) { return solved([&](Statement& s) { state(s, value); }); }, at);
  }
  /// Σ h b_i price_i: the price of moving a bound all along.
  static double total(const Trajectory& motion, const Eigen::MatrixXd& prices) {
    const Eigen::Index s = motion.stages();
    double sum = 0.0;
    for (Eigen::Index row = 0; row < prices.rows(); ++row) {
      sum += motion.step(row / s) * motion.tableau.b[row % s] * prices(row, 0);
    }
    return sum;
  }
  static void expect_price(double price, double slope, double sign) {
    EXPECT_GT(sign * price, 0.01);
    EXPECT_NEAR(price, slope, 1e-3 * std::abs(slope));
  }
};

TEST_P(BoundMultipliersOf, ControlsAreNegativeAtUpperAndPositiveAtLowerBounds) {
  const auto upper = [](Statement& s, double most) { s.u = Bounds::all(1, -tests::infinity, most); };
  const Trajectory pushed = solved([&](Statement& s) { upper(s, 5.0); });
  expect_price(total(pushed, pushed.prices.stage_u), slope(upper, 5.0), -1.0);
  const auto lower = [](Statement& s, double least) { s.u = Bounds::all(1, least, tests::infinity); };
  const Trajectory motion = solved([&](Statement& s) { lower(s, -5.0); });
  expect_price(total(motion, motion.prices.stage_u), slope(lower, -5.0), 1.0);
}

TEST_P(BoundMultipliersOf, VelocitiesAndPathConstraints) {
  const auto velocity = [](Statement& s, double most) { s.v = Bounds::all(1, -tests::infinity, most); };
  const Trajectory slow = solved([&](Statement& s) { velocity(s, 1.3); });
  expect_price(total(slow, slow.prices.stage_v), slope(velocity, 1.3), -1.0);
  const auto path = [](Statement& s, double least) {
    s.path_constraints = [](const ControlledState& x) { return ExpressionVector::Constant(1, x.u[0] + x.q[0]); };
    s.path = Bounds::all(1, least, tests::infinity);
  };
  const Trajectory motion = solved([&](Statement& s) { path(s, -4.0); });
  expect_price(total(motion, motion.prices.path), slope(path, -4.0), 1.0);
}

TEST_P(BoundMultipliersOf, ConfigurationsAtTheNodesAndAtFreeEnds) {
  // On its way through a point beyond the end it would go on farther than it may.
  const auto wall = [](Statement& s, double most) {
    s.interior = {{.relative_time = 0.4, .q = Bounds::all(1, 1.2, 1.2)}};
    s.q = Bounds::all(1, -tests::infinity, most);
  };
  const Trajectory stopped = solved([&](Statement& s) { wall(s, 1.22); });
  Eigen::Index node = 0;
  EXPECT_LT((stopped.node_times.array() - 0.4).abs().minCoeff(&node), 1e-12);
  expect_price(stopped.prices.q.sum() - stopped.prices.q(node, 0), slope(wall, 1.22), -1.0);
  const auto end = [](Statement& s, double least) { s.last.q = Bounds::all(1, least, tests::infinity); };
  expect_price(solved([&](Statement& s) { end(s, 0.8); }).prices.q(intervals, 0), slope(end, 0.8), 1.0);
  const auto rest = [](Statement& s, double most) { s.last.v = Bounds::all(1, -tests::infinity, most); };
  expect_price(solved([&](Statement& s) { rest(s, 0.5); }).prices.v(intervals, 0), slope(rest, 0.5), -1.0);
}

TEST_P(BoundMultipliersOf, RangesOfUnknownParameters) {
  const auto at_most = [](double mass) { return solved(tests::UnknownMass(0.1, mass)); };
  expect_price(at_most(0.3).prices.unknowns[0], slope(at_most, 0.3), -1.0);
  const auto at_least = [](double mass) { return solved(tests::UnknownMass(mass, 10.0)); };
  expect_price(at_least(0.6).prices.unknowns[0], slope(at_least, 0.6), 1.0);
  EXPECT_NEAR(solved(tests::UnknownMass()).prices.unknowns[0], 0.0, 1e-7);
}

TEST_P(BoundMultipliersOf, TheHorizon) {
  const auto longest = [](Statement& s, double most) { s.horizon = {0.5, most}; };
  expect_price(solved([&](Statement& s) { longest(s, 1.1); }).prices.horizon, slope(longest, 1.1), -1.0);
  const auto shortest = [](Statement& s, double least) {
    s.running_cost = [](const ControlledState& x) { return 0.5 * x.u[0] * x.u[0] + 40.0; };
    s.horizon = {least, 2.0};
  };
  expect_price(solved([&](Statement& s) { shortest(s, 0.95); }).prices.horizon, slope(shortest, 0.95), 1.0);
}

TEST_P(BoundMultipliersOf, NothingNeedNoEvaluation) {
  const tests::DoubleIntegrator problem;
  const auto program = tests::transcribe(problem, GetParam(), Grid::uniform(intervals));
  const BoundMultipliers prices = bound_multipliers(*program, Eigen::VectorXd(), Eigen::VectorXd());  // at no point
  for (const Eigen::MatrixXd* table :
       {&prices.q, &prices.v, &prices.y, &prices.stage_v, &prices.stage_u, &prices.path}) {
    EXPECT_EQ(table->size(), 0);
  }
  EXPECT_EQ(prices.unknowns.size(), 0);
  EXPECT_EQ(prices.horizon, 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, BoundMultipliersOf, testing::ValuesIn(every_scheme()), tests::by_label);

}  // namespace
}  // namespace dmocbench
