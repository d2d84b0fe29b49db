#include "bench/run/solve_case.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "methods/transcription/start.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// L = ½v² + log(q - 1)/100, f = u, C = ½au²; from q = 2 down to 2 - ¼ speed and back in T = 1.
class ThrownDown final : public tests::SmallProblem {
 public:
  ThrownDown(double speed, double a) : SmallProblem("thrown_down", at(2.0, -speed), at(2.0, speed), 1.0, 1), a_(a) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v[0] * x.v[0] + 0.01 * log(x.q[0] - 1.0);
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * a_ * x.u[0] * x.u[0]; }

 private:
  double a_;
};

SolvedCase solved(double speed, double a) {
  const auto problem = std::make_shared<ThrownDown>(speed, a);
  const Case the_case{.problem = problem, .method = "dmoc", .solver = "ipopt", .grid = Grid::uniform(16)};
  return solve_case(the_case, {guessed_motion(*problem)}, *make_solver("ipopt"), SolverOptions{}.tolerance, 1);
}

TEST(SolveCase, AnAnswerAcrossASingularityIsAFailedEvaluation) {
  SolvedCase across = solved(8.0, 1.0);
  ASSERT_EQ(across.solution.status, Status::too_coarse) << across.solution.message;
  static_cast<void>(check_independently(across));
  EXPECT_EQ(across.solution.status, Status::evaluation_failed);
  EXPECT_PRED2(tests::says, across.solution.message, "lagrangian is not a number in interval 2");
  SolvedCase above = solved(1.0, 1.0);
  static_cast<void>(check_independently(above));
  EXPECT_EQ(above.solution.status, Status::solved) << above.solution.message;
}

TEST(SolveCase, SaysWhichScaleWouldSuitACostFarFromOne) {
  // u is about 2 speed, so the cost is about 2 a speed².
  const SolvedCase small = solved(1.0, 0.5e-5);
  ASSERT_EQ(small.solution.status, Status::solved) << small.solution.message;
  EXPECT_PRED2(tests::says, small.solution.message, "consider cost_scale = 100000 instead of 1");
  EXPECT_EQ(solved(1.0, 0.5).solution.message.find("cost_scale"), std::string::npos);
}

/// A mass on a spring, 1 m in 10 s with least ∫ ½u², in a wave of some periods: L = ½v² - ½q², f = u + 0.3 cos.
class InWave final : public tests::SmallProblem {
 public:
  explicit InWave(double periods) : SmallProblem("in_wave", at(0.0, 0.0), at(1.0, 0.0), 10.0, 1), periods_(periods) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v[0] * x.v[0] - 0.5 * x.q[0] * x.q[0];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return one(x.u[0] + 0.3 * cos(0.2 * std::numbers::pi * periods_ * x.t));
  }

 private:
  double periods_;
};

TEST(SolveCase, IsTooCoarseWhereEveryIntervalMissesToTheSameSide) {
  const auto solved = [](double periods, const char* method) {
    const auto problem = std::make_shared<InWave>(periods);
    const Case the_case{.problem = problem, .method = method, .solver = "ipopt", .grid = Grid::uniform(64)};
    return solve_case(the_case, {guessed_motion(*problem)}, *make_solver("ipopt"), SolverOptions{}.tolerance, 1);
  };
  for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
    const SolvedCase sampled_at_its_crests = solved(64.0, method);
    EXPECT_EQ(sampled_at_its_crests.solution.status, Status::too_coarse) << method;
    EXPECT_LT(sampled_at_its_crests.accuracy->relative_jump, largest_jump_of_a_motion) << method;
    EXPECT_PRED2(tests::says, sampled_at_its_crests.solution.message,
                 "estimated relative error of q, p and cost is 0.59");
    EXPECT_EQ(solved(8.0, method).solution.status, Status::solved) << method;
  }
}

/// Pushed from rest with a power u, f = u/v, with the least ∫ ½u² over 1 m in 1 s: at rest the force is infinite, the
/// motion is not.
class PowerFromRest final : public tests::SmallProblem {
 public:
  PowerFromRest() : SmallProblem("power_from_rest", at(0.0, 0.0), at(1.0, 1.5), 1.0, 1) {}
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return one(x.u[0] / x.v[0]); }
};

TEST(SolveCase, AdvisesNoFinerGridWhereAForceIsSingularOnTheMotion) {
  const auto problem = std::make_shared<PowerFromRest>();
  const Case the_case{.problem = problem, .method = "dmoc", .solver = "ipopt", .grid = Grid::uniform(32)};
  const SolvedCase solved = solve_case(the_case, {guessed_motion(*problem)}, *make_solver("ipopt"), 1e-8, 1);
  ASSERT_EQ(solved.solution.status, Status::too_coarse) << solved.solution.message;
  EXPECT_PRED2(tests::says, solved.solution.message, "force is not a finite number");
  EXPECT_PRED2(tests::says, solved.solution.message, "More intervals do not help");
  EXPECT_EQ(solved.solution.message.find("the grid is too coarse"), std::string::npos) << solved.solution.message;
}

/// An oscillator between two places without a control: Hamilton's principle, with the action as cost. q = sin 2t /
/// sin 2.
class LeastAction final : public tests::SmallProblem {
 public:
  LeastAction() : SmallProblem("least_action", at(0.0, 0.0), at(1.0, 0.0), 1.0, 0) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v[0] * x.v[0] - 2.0 * x.q[0] * x.q[0];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& /*x*/) const override { return one(0.0); }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * x.v[0] * x.v[0] - 2.0 * x.q[0] * x.q[0];
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.first.free_velocity(0);
    bounds.last.free_velocity(0);
    return bounds;
  }
};

TEST(SolveCase, SolvesAProblemWithoutControlsByEverySolverAndMethod) {
  const auto problem = std::make_shared<LeastAction>();
  for (const char* solver : {"ipopt", "interior_point", "sqp", "auto"}) {
    for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
      SCOPED_TRACE(std::string(solver) + " " + method);
      const Case the_case{.problem = problem, .method = method, .solver = solver, .grid = Grid::uniform(64)};
      const SolvedCase solved = solve_case(the_case, {guessed_motion(*problem)}, *make_solver(solver), 1e-10, 1);
      EXPECT_EQ(solved.solution.status, Status::solved) << solved.solution.message;
      EXPECT_NEAR(solved.trajectory->q(32, 0), std::sin(1.0) / std::sin(2.0), 1e-3);
    }
  }
}

/// From rest to rest over a distance in T = 1: L = ½v², f = u, C = ½u²; |v| is 3/2 of the distance, |u| 6 times it.
class Shift final : public tests::SmallProblem {
 public:
  explicit Shift(double distance) : SmallProblem("shift", at(0.0, 0.0), at(distance, 0.0), 1.0, 1) {}
};

TEST(SolveCase, NamesWhatIsFarFromOne) {
  const auto message_over = [](double distance) {
    const auto problem = std::make_shared<Shift>(distance);
    const Case the_case{.problem = problem, .method = "dmoc", .solver = "ipopt", .grid = Grid::uniform(16)};
    return solve_case(the_case, {guessed_motion(*problem)}, *make_solver("ipopt"), 1e-6, 1).solution.message;
  };
  EXPECT_PRED2(tests::says, message_over(4e3), "Sizes are far from 1: u1 (2e+04)");
  EXPECT_PRED2(tests::says, message_over(2e-5), "Sizes are far from 1: q1 (2e-05), the rate of q1 (3e-05). ");
  EXPECT_EQ(message_over(1.0).find("Sizes are far"), std::string::npos) << message_over(1.0);
}

}  // namespace
}  // namespace dmocbench
