#include "methods/solvers/auto/auto_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/cart_pole.hpp"
#include "tests/binaries/own_problems/mountain_car.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

/// A program that both solve in some iterations.
class AutoSolverTest : public testing::Test {
 protected:
  [[nodiscard]] Solution solve(const Solver& solver, const Eigen::VectorXd& start) {
    return solver.solve(program_, start);
  }
  static SolverOptions at_most(int iterations) {
    SolverOptions options;
    options.most_iterations = iterations;
    return options;
  }

  CartPole problem_;
  Transcription program_{problem_, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(16)};
  Eigen::VectorXd start_ = sample(program_, guessed_motion(problem_));
  Solution alone_ = solve(InteriorPointSolver(), start_);
};

TEST_F(AutoSolverTest, GivesTheAnswerOfInteriorPointWhereThatSolves) {
  const Solution solution = solve(AutoSolver(SolverOptions{}), start_);
  ASSERT_EQ(alone_.status, Status::solved);
  EXPECT_EQ(alone_.solver, "interior_point");
  EXPECT_EQ(solution.solver, "interior_point");
  EXPECT_EQ(solution.status, Status::solved);
  EXPECT_EQ(solution.primal, alone_.primal);
  EXPECT_EQ(solution.major_iterations, alone_.major_iterations);
  EXPECT_EQ(solution.linear_systems, alone_.linear_systems);
  EXPECT_EQ(solution.total_evaluations(), alone_.total_evaluations());
}

TEST_F(AutoSolverTest, GoesOnByIpoptFromTheLastPointAndCountsTheWorkOfBoth) {
  // One iteration less than it needs: the first fails near the solution, and the second finds it from there.
  const SolverOptions options = at_most(tests::value_of(alone_.major_iterations) - 1);
  const Solution first = solve(InteriorPointSolver(options), start_);
  const Solution second = solve(IpoptSolver(options), first.primal);
  ASSERT_EQ(first.status, Status::iteration_limit);
  ASSERT_EQ(second.status, Status::solved);
  const Solution both = solve(AutoSolver(options), start_);
  EXPECT_EQ(both.solver, "ipopt");
  EXPECT_EQ(both.status, Status::solved);
  EXPECT_EQ(both.primal, second.primal);
  EXPECT_EQ(tests::value_of(both.major_iterations),
            tests::value_of(first.major_iterations) + tests::value_of(second.major_iterations));
  EXPECT_EQ(tests::value_of(both.total_evaluations()),
            tests::value_of(first.total_evaluations()) + tests::value_of(second.total_evaluations()));
  EXPECT_EQ(both.linear_systems, std::nullopt);
}

TEST_F(AutoSolverTest, AsksIpoptAtOnceWhereInteriorPointRefusesTheProgram) {
  tests::SmallProgram program = tests::rosenbrock();
  const Solution solution = AutoSolver(SolverOptions{}).solve(program, tests::vector({-1.2, 1.0}));
  EXPECT_EQ(solution.solver, "ipopt");
  EXPECT_EQ(solution.primal, IpoptSolver(SolverOptions{}).solve(program, tests::vector({-1.2, 1.0})).primal);
}

TEST_F(AutoSolverTest, DoesNotGoOnWhereTheSolveWasStopped) {
  SolverOptions options;
  options.stop_requested = [] { return true; };
  const Solution solution = solve(AutoSolver(options), start_);
  EXPECT_EQ(solution.status, Status::interrupted);
  EXPECT_EQ(solution.solver, "interior_point");
}

TEST_F(AutoSolverTest, PassesOptionsOnToTheSolverThatHasThem) {
  const auto with = [](const NamedOptions& named) { return make_solver("auto", {}, named); };
  EXPECT_EQ(solve(*with({{"factorisation", "sparse"}, {"mu_strategy", "adaptive"}}), start_).status, Status::solved);
  EXPECT_THROW((void)with({{"no_such_option", "1"}}), Error);
  EXPECT_THROW((void)with({{"factorisation", "banded"}}), Error);
}

/// At 64 intervals both solvers end where the time is too short for the swing back, though motions exist.
TEST(AutoSolver, StartsAgainFromAMotionThatMeetsTheConstraintsWhereBothFail) {
  const MountainCar problem;
  Transcription program(problem, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(64));
  const Eigen::VectorXd start = sample(program, guessed_motion(problem));
  const Solution first = InteriorPointSolver().solve(program, start);
  const Solution second = IpoptSolver(SolverOptions{}).solve(program, first.primal);
  ASSERT_FALSE(is_solved(first.status));
  ASSERT_FALSE(is_solved(second.status));
  const Solution solution = AutoSolver(SolverOptions{}).solve(program, start);
  EXPECT_EQ(solution.status, Status::solved);
  EXPECT_EQ(solution.solver, "interior_point");
  EXPECT_THAT(solution.failed_before, testing::HasSubstr("interior_point and ipopt failed"));
  EXPECT_GT(tests::value_of(solution.major_iterations),
            tests::value_of(first.major_iterations) + tests::value_of(second.major_iterations));
}

/// Its three attempts, the descents on the violation and the judgement ask at many places whether they must stop.
TEST(AutoSolver, EndsWithAStatusWhereverItIsStopped) {
  const MountainCar problem;
  Transcription program(problem, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(32));
  const Eigen::VectorXd start = sample(program, guessed_motion(problem));
  long long questions = 0;
  SolverOptions options;
  options.most_iterations = 20;
  options.stop_requested = [&] { return ++questions < 0; };
  static_cast<void>(AutoSolver(options).solve(program, start));
  const long long all = questions;
  ASSERT_GT(all, 100);
  for (long long share = 1; share < 24; ++share) {
    questions = 0;
    options.stop_requested = [&] { return ++questions >= share * all / 24; };
    const Solution solution = AutoSolver(options).solve(program, start);
    EXPECT_EQ(solution.status, Status::interrupted) << share << " of 24: " << solution.message;
    EXPECT_EQ(solution.primal.size(), start.size());
  }
}

/// From (0, 0) to (4, 0) in the least time, past a circle next to (2, 0), which costs no time: T = 4, and many motions
/// across the way are optimal.
class PastACircle final : public tests::SmallProblem {
 public:
  explicit PastACircle(double height)
      : SmallProblem("past_a_circle", BoundaryState::at_rest(tests::vector({0.0, 0.0})),
                     BoundaryState::at_rest(tests::vector({4.0, 0.0})), 6.0, 2),
        height_(height) {}
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = SmallProblem::bounds();
    bounds.u = Bounds::all(2, -1.0, 1.0);
    bounds.horizon = {.lower = 0.5, .upper = 50.0};
    return bounds;
  }
  [[nodiscard]] Expression running_cost(const ControlledState& /*x*/) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override { return last.t; }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return one(pow(x.q[0] - 2.0, 2.0) + pow(x.q[1] - height_, 2.0) - 0.25);
  }

 private:
  double height_;
};

/// The answer to it, settled.
Solution solved_past_a_circle(double height) {
  const PastACircle problem(height);
  Transcription program(problem, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(64));
  SolverOptions options;
  options.most_iterations = 150;
  Solution solution = AutoSolver(options).solve(program, sample(program, guessed_motion(problem)));
  settle(program, options.tolerance, solution);
  solution.objective /= program.cost_scale();
  return solution;
}

TEST(AutoSolver, PassesAnObstacleStraightAheadOnOneSide) {
  const Solution solution = solved_past_a_circle(0.0);
  EXPECT_TRUE(is_solved(solution.status)) << solution.message;
  EXPECT_NEAR(solution.objective, 4.0, 1e-6);
  EXPECT_THAT(solution.failed_before, testing::HasSubstr("near the guess"));
}

TEST(Settle, CallsOneOfManyTrajectoriesSolvedAndSaysThatThereAreOthers) {
  const Solution solution = solved_past_a_circle(0.1);
  EXPECT_EQ(solution.status, Status::solved);
  EXPECT_NEAR(solution.objective, 4.0, 1e-6);
  EXPECT_GT(tests::value_of(solution.correction), settled);
  EXPECT_THAT(solution.message, testing::HasSubstr("does not determine the trajectory"));
}

}  // namespace
}  // namespace dmocbench
