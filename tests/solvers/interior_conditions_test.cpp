// Bounds on the state at times between the ends: splines, velocities and first-order states, prices, refusals.
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/diagnostics/accuracy.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "problems/control_rate.hpp"
#include "problems/two_link_with_motors.hpp"
#include "problems/waypoints.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Restated;
using tests::Scheme;
using Statement = Restated::Statement;

class InteriorConditions : public testing::TestWithParam<tests::Way> {
 protected:
  static Trajectory solved(const Problem& problem, Eigen::Index intervals) {
    return solved(problem, intervals, guessed_motion(problem));
  }
  static Trajectory solved(const Problem& problem, Eigen::Index intervals, const Motion& start) {
    const auto program = tests::transcribe(problem, GetParam().scheme, Grid::uniform(intervals));
    SolverOptions options;
    options.tolerance = 1e-11;
    const Solution solution = make_solver(GetParam().solver, options)->solve(*program, sample(*program, start));
    EXPECT_EQ(solution.status, Status::solved) << solution.message;
    return read_trajectory(*program, solution.primal, solution.multipliers);
  }
  static int order() { return GetParam().scheme.tableau().order; }
};

/// A particle from 0 to 1 at rest in T = 1, C = ½u², through q = a and q̇ = b at the time `time`.
Restated motion_through(const Problem& base, double time, double q, double v) {
  return Restated(base, [&](Statement& s) {
    s.interior.push_back({.relative_time = time});
    if (!std::isnan(q)) s.interior.back().q = Bounds::all(1, q, q);
    if (!std::isnan(v)) s.interior.back().v = Bounds::all(1, v, v);
  });
}

/// ½∫u² of the cubic from (q_0, v_0) to (q_1, v_1) in the time h.
double cost_of_cubic(double q0, double v0, double q1, double v1, double h) {
  const double mean = (q1 - q0) / h;
  return 2.0 / h * (v0 * v0 + v0 * v1 + v1 * v1 - 3.0 * mean * (v0 + v1) + 3.0 * mean * mean);
}

constexpr double unbound = std::numeric_limits<double>::quiet_NaN();

TEST_P(InteriorConditions, MakeTheCubicSplineThroughThePoints) {
  // Cubics are exact for methods of order 4.
  const Waypoints problem;
  const double optimum = problem.card().reference->objective;
  const auto error = [&](Eigen::Index intervals) {
    const Trajectory motion = solved(problem, intervals);
    EXPECT_EQ(motion.node_times.size(), intervals + 1);
    const Eigen::Index first = (25 * intervals + 30) / 60;
    EXPECT_NEAR(motion.node_times[first], 25.0, 1e-12);
    EXPECT_NEAR((motion.q.row(first) - Eigen::RowVector2d(4.0, 3.0)).norm(), 0.0, 1e-12);
    return std::abs(motion.cost - optimum);
  };
  if (order() > 2) {
    EXPECT_LT(error(7), 1e-10);
  } else {
    EXPECT_NEAR(std::log2(error(24) / error(48)), 2.0, 0.1);
  }
}

TEST_P(InteriorConditions, GiveVelocitiesAtAnyNode) {
  const tests::DoubleIntegrator base;
  for (const double q : {0.2, unbound}) {
    const Restated problem = motion_through(base, 0.25, q, 1.5);
    // Where q is free it is such that the cost is least: a parabola in q.
    const auto cost_at = [](double at) {
      return cost_of_cubic(0.0, 0.0, at, 1.5, 0.25) + cost_of_cubic(at, 1.5, 1.0, 0.0, 0.75);
    };
    const double second = cost_at(1.0) - 2.0 * cost_at(0.0) + cost_at(-1.0);
    const double least = -0.5 * (cost_at(1.0) - cost_at(-1.0)) / second;
    const double optimum = cost_at(std::isnan(q) ? least : q);
    const auto error = [&](Eigen::Index intervals) {
      const Trajectory motion = solved(problem, intervals);
      EXPECT_NEAR(motion.v(intervals / 4, 0), 1.5, 1e-9);
      return std::abs(motion.cost - optimum);
    };
    if (order() > 2) {
      EXPECT_LT(error(8), 1e-8 * optimum);
    } else {
      EXPECT_NEAR(std::log2(error(32) / error(64)), 2.0, 0.15);
    }
  }
}

TEST_P(InteriorConditions, BoundFirstOrderStates) {
  const ControlRate base;
  const auto solved_with = [&](double least) {
    const Restated problem(base, [&](Statement& s) {
      s.u = base.bounds().u;
      s.interior = {{.relative_time = 0.5, .y = Bounds::all(1, least, tests::infinity)}};
    });
    return solved(problem, 16);
  };
  const Trajectory motion = solved_with(0.6);
  EXPECT_NEAR(motion.y(8, 0), 0.6, 1e-6);
  EXPECT_LT(solved(base, 16).y(8, 0), 0.3);
  constexpr double step = 1e-2;
  const double slope = (solved_with(0.6 + step).cost - solved_with(0.6 - step).cost) / (2.0 * step);
  EXPECT_GT(slope, 1e-3);
  EXPECT_NEAR(motion.prices.y(8, 0), slope, 0.05 * slope);  // the sets of active bounds change
  EXPECT_LT(std::abs(motion.prices.y(7, 0)), 1e-6);
}

/// A particle in the plane from (-1, 0) to (1, 0) at rest in T = 1, C = ½|u|², through the circle |q - c|² = ¼ around
/// c = (0, 1) at T/2. y is |q - c|². The optimum passes (0, ½): J = 24 + 96 · ¼.
class ThroughACircle final : public tests::SmallProblem {
 public:
  ThroughACircle() : SmallProblem("through_a_circle", beside(-1.0), beside(1.0), 1.0, 2) {}
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"square"}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return one(2.0 * (x.q[0] * x.v[0] + (x.q[1] - 1.0) * x.v[1]));
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_first_order(0);
    bounds.interior = {{.relative_time = 0.5, .y = Bounds::all(1, 0.25, 0.25)}};
    return bounds;
  }

 private:
  static BoundaryState beside(double x) {
    BoundaryState state = BoundaryState::at_rest(Eigen::Vector2d(x, 0.0));
    state.y = Eigen::VectorXd::Constant(1, 2.0);
    return state;
  }
};

TEST_P(InteriorConditions, BoundFunctionsOfTheStateByAFirstOrderStateWithTheirRate) {
  const Trajectory motion = solved(ThroughACircle(), 16);
  const bool conserves_squares = GetParam().scheme.family == "gauss";
  const double square = (motion.q.row(8) - Eigen::RowVector2d(0.0, 1.0)).squaredNorm();
  EXPECT_NEAR(square, 0.25, conserves_squares ? 1e-10 : 0.02);
  const double error = motion.cost - 48.0;
  if (std::abs(error) < 1e-7) return;  // of cubics
  EXPECT_NEAR(std::log2(error / (solved(ThroughACircle(), 32).cost - 48.0)), order(), 0.2);
}

TEST_P(InteriorConditions, HaveThePriceOfTheirBounds) {
  const tests::DoubleIntegrator base;
  constexpr double step = 1e-3;
  const auto slope = [&](double dq, double dv) {
    const auto cost = [&](double sign) {
      return solved(motion_through(base, 0.25, 0.3 + sign * dq, 1.0 + sign * dv), 8).cost;
    };
    return (cost(1.0) - cost(-1.0)) / (2.0 * step);
  };
  const Trajectory motion = solved(motion_through(base, 0.25, 0.3, 1.0), 8);
  EXPECT_NEAR(motion.prices.q(2, 0), slope(step, 0.0), 1e-5 * std::abs(motion.prices.q(2, 0)));
  EXPECT_NEAR(motion.prices.v(2, 0), slope(0.0, step), 1e-5 * std::abs(motion.prices.v(2, 0)));
  EXPECT_GT(std::abs(motion.prices.v(2, 0)), 1.0);
  EXPECT_EQ(motion.prices.q(0, 0), 0.0);
}

TEST_P(InteriorConditions, WorkOnTheMotorsOfAnArmAndLeaveAMotion) {
  const TwoLinkWithMotors arm;
  const Restated problem(arm, [](Statement& s) {
    const Eigen::VectorXd v = Eigen::VectorXd::Constant(2, 2.0);
    s.interior = {{.relative_time = 0.4, .v = {v.array() - 1.0, v}}};
  });
  const auto program = tests::transcribe(problem, GetParam().scheme, Grid::uniform(64));
  const Trajectory motion = solved(problem, 64, guessed_motion(arm));
  const Eigen::Index node = 26;
  EXPECT_NEAR(motion.node_times[node], 0.4 * problem.horizon(), 1e-12);
  EXPECT_LT(motion.v.row(node).maxCoeff(), 2.0 + 1e-6);
  EXPECT_GT(motion.v.row(node).minCoeff(), 1.0 - 1e-6);
  EXPECT_LT(accuracy(program->traced_problem(), motion).relative_jump, order() == 2 ? 2e-2 : 1e-3);
}

INSTANTIATE_TEST_SUITE_P(All, InteriorConditions,
                         testing::ValuesIn(tests::ways_by({"ipopt", "interior_point", "auto"})), tests::by_label);

TEST(InteriorConditionsRefused, OutsideOfTheHorizonTwiceOrAgainstOtherBounds) {
  const tests::DoubleIntegrator base;
  const auto sentence = [&](const std::function<void(Statement&)>& state, Eigen::Index intervals = 8) {
    const Restated problem(base, state);
    return tests::sentence_of_error([&] {
      static_cast<void>(tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(intervals)));
    });
  };
  const auto at = [](double time, Bounds q = {}, Bounds v = {}) {
    return InteriorBounds{.relative_time = time, .q = std::move(q), .v = std::move(v)};
  };
  for (const double time : {0.0, 1.0, 1.5, unbound}) {
    EXPECT_PRED2(tests::says, sentence([&](Statement& s) { s.interior = {at(time)}; }),
                 "bounds().interior[0].relative_time");
  }
  EXPECT_PRED2(tests::says, sentence([&](Statement& s) { s.interior = {at(0.5), at(0.2), at(0.5)}; }), "two entries");
  EXPECT_PRED2(tests::says, sentence([&](Statement& s) { s.interior = {at(0.5, Bounds::all(2, 0.0, 1.0))}; }),
               "expected 1");
  EXPECT_PRED2(tests::says, sentence([&](Statement& s) { s.interior = {at(0.5, Bounds::all(1, 2.0, 1.0))}; }),
               "above the upper");
  EXPECT_PRED2(tests::says, sentence([&](Statement& s) {
                 s.q = Bounds::all(1, -1.0, 1.0);
                 s.interior = {at(0.5, Bounds::all(1, 2.0, 3.0))};
               }),
               "leave no value for q[0]");
  EXPECT_PRED2(tests::says, sentence([&](Statement& s) {
                 s.v = Bounds::all(1, -1.0, 1.0);
                 s.interior = {at(0.5, {}, Bounds::all(1, 2.0, 3.0))};
               }),
               "leave no value for v[0]");
  EXPECT_PRED2(tests::says,
               sentence(
                   [&](Statement& s) {
                     s.interior = {at(0.3), at(0.5)};
                   },
                   2),
               "at least 3 intervals");
}

}  // namespace
}  // namespace dmocbench
