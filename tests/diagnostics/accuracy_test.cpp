#include "methods/diagnostics/accuracy.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// The exact optimum of the double integrator, u = 6 - 12t, on a grid, as two Gauss stages carry it.
Trajectory exact_optimum(const Problem& problem, Eigen::Index intervals) {
  const auto program = tests::transcribe(problem, {"dmoc", 2}, Grid::uniform(intervals));
  Trajectory motion = read_trajectory(*program, sample(*program, guessed_motion(problem)), Eigen::VectorXd());
  const Eigen::ArrayXd t = motion.node_times;
  motion.q = 3.0 * t.square() - 2.0 * t.cube();
  motion.v = 6.0 * t - 6.0 * t.square();
  motion.stage_u = 6.0 - 12.0 * motion.stage_times.array();
  return motion;
}

TEST(Accuracy, FindsNoJumpInAnExactMotion) {
  const tests::DoubleIntegrator problem;
  EXPECT_LT(accuracy(problem, exact_optimum(problem, 6)).jump, 1e-13);
}

TEST(Accuracy, FindsWhereAMotionIsTornAndByHowMuch) {
  const tests::DoubleIntegrator problem;
  Trajectory torn = exact_optimum(problem, 8);
  torn.q.bottomRows(4).array() += 0.25;  // from node 5 on: q now ranges from 0 to 1.25
  const Accuracy replay = accuracy(problem, torn);
  EXPECT_EQ(replay.interval, 4);
  EXPECT_NEAR(replay.jump, 0.25, 1e-13);
  EXPECT_NEAR(replay.relative_jump, 0.25 / 1.25, 1e-13);
}

TEST(Accuracy, AddsUpJumpsToTheSameSideOnly) {
  const tests::DoubleIntegrator problem;
  constexpr double jump = 0.04;
  Trajectory drifting = exact_optimum(problem, 16);
  drifting.q += jump * Eigen::VectorXd::LinSpaced(17, 0.0, 16.0);
  const Accuracy one_sided = accuracy(problem, drifting);
  EXPECT_NEAR(one_sided.relative_jump, jump / 1.64, 1e-12);
  EXPECT_NEAR(one_sided.accumulated_jump, 16.0 * jump / 1.64, 1e-12);
  EXPECT_FALSE(one_sided.is_motion());
  Trajectory zigzag = exact_optimum(problem, 16);
  for (Eigen::Index k = 1; k <= 16; k += 2) zigzag.q(k, 0) += jump;
  const Accuracy to_both_sides = accuracy(problem, zigzag);
  EXPECT_NEAR(to_both_sides.accumulated_jump, to_both_sides.relative_jump, 1e-12);
  EXPECT_TRUE(to_both_sides.is_motion());
}

/// C = ½u² (1 + a cos 2π w t): by one stage on as many intervals as periods the program sees 1 - a throughout.
TEST(Accuracy, FindsACostThatOscillatesAsFastAsTheGrid) {
  constexpr double amplitude = 0.3;
  const tests::DoubleIntegrator base;
  const tests::Restated waves(base, [](tests::Restated::Statement& s) {
    s.running_cost = [](const ControlledState& x) {
      return 0.5 * x.u[0] * x.u[0] * (1.0 + amplitude * cos(2.0 * std::numbers::pi * 16.0 * x.t));
    };
  });
  const auto error_on = [&](Eigen::Index intervals) {
    const auto solved = tests::solve(waves, {"dmoc", 1}, Grid::uniform(intervals), guessed_motion(waves));
    return accuracy(waves, solved.trajectory);
  };
  EXPECT_NEAR(error_on(16).cost_error, amplitude, 1e-8);
  EXPECT_FALSE(error_on(16).is_motion());
  EXPECT_LT(error_on(512).cost_error, 1e-3);
  EXPECT_TRUE(error_on(512).is_motion());
}

/// The same with half as many periods as intervals: the quadrature is right on average. The price of constant controls
/// is 1 on average, and the reciprocal of the average reciprocal is √(1 - a²).
TEST(Accuracy, FindsWhatControlsThatFollowTheirPriceWithinTheIntervalsWouldSave) {
  for (const double amplitude : {0.0, 0.3, 0.5, 0.9}) {
    const tests::DoubleIntegrator base;
    const tests::Restated waves(base, [&](tests::Restated::Statement& s) {
      s.running_cost = [&](const ControlledState& x) {
        return 0.5 * x.u[0] * x.u[0] * (1.0 + amplitude * cos(2.0 * std::numbers::pi * 16.0 * x.t));
      };
    });
    for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
      const auto on = [&](Eigen::Index intervals) {
        return accuracy(waves,
                        tests::solve(waves, {method, 1}, Grid::uniform(intervals), guessed_motion(waves)).trajectory);
      };
      const double saving = 1.0 / std::sqrt(1.0 - amplitude * amplitude) - 1.0;
      EXPECT_NEAR(on(32).control_saving, saving, 0.05 * saving + 0.002) << method << ' ' << amplitude;
      EXPECT_EQ(on(32).is_motion(), saving < 0.1);
      EXPECT_LT(on(512).control_saving, 0.1 * saving + 1e-4);
    }
  }
}

/// f = u + a sin(2π w t + 0.5): by one stage on as many intervals as periods it is one constant, which u cancels.
TEST(Accuracy, FindsWhatAForceThatOscillatesAsFastAsTheGridAddsToTheCost) {
  constexpr double amplitude = 0.5;
  class Waves final : public ForwardingProblem {
   public:
    explicit Waves(const Problem& base) : ForwardingProblem(base) {}
    [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
      return x.u + ExpressionVector::Constant(1, amplitude * sin(2.0 * std::numbers::pi * 16.0 * x.t + 0.5));
    }
  };
  const tests::DoubleIntegrator base;
  const Waves problem(base);
  const auto solved_on = [&](Eigen::Index intervals) {
    return tests::solve(problem, {"dmoc", 1}, Grid::uniform(intervals), guessed_motion(problem)).trajectory;
  };
  const double right = solved_on(2048).cost;
  const Trajectory coarse = solved_on(16);
  const Accuracy found = accuracy(problem, coarse);
  EXPECT_NEAR(found.cost_miss, std::abs(coarse.cost - right) / coarse.cost, 0.1 * found.cost_miss);
  EXPECT_LT(accuracy(problem, solved_on(512)).cost_miss, 1e-3);
}

TEST(Accuracy, DoesNotJudgeACostThatIsRoundOff) {
  const tests::DoubleIntegrator problem;
  Trajectory motion = exact_optimum(problem, 8);
  motion.stage_u *= 1e-9;
  motion.stage_u.reverseInPlace();
  motion.cost = 0.0;
  EXPECT_LT(accuracy(problem, motion).cost_error, 1e-9);
}

TEST(Accuracy, DoesNotCallABodyAtRestTornByRounding) {
  const tests::DoubleIntegrator problem;
  Trajectory at_rest = exact_optimum(problem, 8);
  at_rest.stage_u.setZero();
  for (const double place : {0.0, 1.0, 1e6}) {
    at_rest.v = 1e-13 * Eigen::MatrixXd::Random(9, 1);
    at_rest.q = Eigen::MatrixXd::Constant(9, 1, place) + 1e-14 * std::max(1.0, place) * Eigen::MatrixXd::Random(9, 1);
    EXPECT_LT(accuracy(problem, at_rest).relative_jump, 1e-7) << "at " << place;
    at_rest.q.bottomRows(4).array() += 1.0;
    EXPECT_GT(accuracy(problem, at_rest).relative_jump, 0.05) << "torn at " << place;
  }
}

TEST(Accuracy, CountsNoJumpThatIsRoundingAsAShareOfAMotionThatIsHardlyMore) {
  const tests::DoubleIntegrator problem;
  Trajectory slow = exact_optimum(problem, 8);
  slow.q.setZero();
  slow.stage_u.setZero();
  slow.v = 0.3 * smallest_range * Eigen::VectorXd::LinSpaced(9, 0.0, 8.0);
  EXPECT_LT(accuracy(problem, slow).relative_jump, largest_jump_of_a_motion);
  slow.v *= 100.0;
  EXPECT_GT(accuracy(problem, slow).relative_jump, largest_jump_of_a_motion);
}

/// x'' = 400 x + u grows by e^40 over its horizon: a replay of the whole cannot judge a motion that rounding moves.
class Unstable final : public tests::SmallProblem {
 public:
  Unstable() : SmallProblem("unstable", at(1.0, -20.0), at(std::exp(-40.0), -20.0 * std::exp(-40.0)), 2.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v[0] * x.v[0] + 200.0 * x.q[0] * x.q[0];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }
};

TEST(Accuracy, JudgesAnUnstableMotionThatAReplayOfTheHorizonCannot) {
  const Unstable problem;
  const auto program = tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(40));
  Trajectory motion = read_trajectory(*program, sample(*program, guessed_motion(problem)), Eigen::VectorXd());
  motion.q = (-20.0 * motion.node_times.array()).exp();
  motion.v = -20.0 * motion.q;
  motion.stage_u.setZero();
  EXPECT_GT(replay_error(problem, motion).norm(), 1.0);
  EXPECT_LT(accuracy(problem, motion).relative_jump, 1e-10);
}

/// The order of the error at the nodes is 2s. Stage controls have order s + 1 if s > 1, and what they are wrong by acts
/// for the length of an interval.
TEST(Accuracy, FallsOneOrderFasterThanTheErrorOfTheNodesOrOfTheControls) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    for (const tests::Scheme& scheme : tests::schemes_of({"gauss"}, 2)) {
      std::vector<GridError> jumps;
      for (const int intervals : {24, 48, 96}) {
        const Trajectory motion =
            tests::solve(*problem, scheme, Grid::uniform(intervals), tests::common_start(*problem)).trajectory;
        jumps.push_back({1.0 / intervals, accuracy(*problem, motion).jump});
      }
      const double order = fit_order(jumps)->order;
      EXPECT_GT(order, scheme.stages + 2.0 - 0.35) << name << ", " << scheme.label();
      EXPECT_LT(order, 2.0 * scheme.stages + 1.0 + 0.35) << name << ", " << scheme.label();
    }
  }
}

TEST(Accuracy, IsInfiniteWhereTheMotionEndsWithinAnInterval) {
  const tests::BlowUp problem(4.0);
  const auto program = tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(2));
  Trajectory motion = read_trajectory(*program, sample(*program, guessed_motion(problem)), Eigen::VectorXd());
  motion.stage_u.setZero();
  motion.v.setConstant(4.0);
  const Accuracy replay = accuracy(problem, motion);
  EXPECT_EQ(replay.jump, std::numeric_limits<double>::infinity());
  EXPECT_EQ(replay.interval, 0);
}

}  // namespace
}  // namespace dmocbench
