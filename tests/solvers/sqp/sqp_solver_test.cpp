#include "methods/solvers/sqp/sqp_solver.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "problems/registry.hpp"
#include "tests/solvers/sqp/control_bounds.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::everywhere;
using tests::HyperDual;
using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

Solution solve_by_sqp(NonlinearProgram& program, const Eigen::VectorXd& start, const SolverOptions& options = {}) {
  return SqpSolver(options).solve(program, start);
}

SolverOptions with(const std::string& option, const std::string& value) {
  SolverOptions options;
  options.passed_on[option] = value;
  return options;
}

TEST(Sqp, FindsTheKnownOptimaOfHockAndSchittkowski) {
  for (const tests::KnownProgram& known : tests::hock_schittkowski()) {
    for (const char* hessian : {"exact", "limited_memory"}) {
      SCOPED_TRACE("HS " + std::to_string(known.number) + " " + hessian);
      SmallProgram program(known.statement);
      const Solution solution = solve_by_sqp(program, known.start, with("hessian", hessian));
      EXPECT_EQ(solution.status, Status::solved) << solution.message;
      EXPECT_NEAR(solution.objective, known.objective, 1e-8);
      EXPECT_LT((solution.primal - known.optimum).norm(), 2e-5);
      EXPECT_LT(solution.kkt_residual.value(), 1e-9);
      EXPECT_GT(solution.major_iterations.value(), 0);
      EXPECT_GE(solution.minor_iterations.value(), solution.major_iterations.value());
    }
  }
}

TEST(Sqp, FollowsRosenbrocksValley) {
  SmallProgram program = tests::rosenbrock();
  const Solution solution = solve_by_sqp(program, vector({-1.2, 1.0}));
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  EXPECT_LT((solution.primal - vector({1.0, 1.0})).norm(), 1e-8);
}

TEST(Sqp, GivesMultipliersOfOurSign) {
  // HS 71: x₁x₂x₃x₄ >= 25 is active from below: more of it would cost more, so its multiplier is negative.
  const tests::KnownProgram known = tests::hock_schittkowski().back();
  SmallProgram program(known.statement);
  const Solution solution = solve_by_sqp(program, known.start);
  EXPECT_NEAR(solution.multipliers[0], -0.5522936596, 1e-8);
  EXPECT_NEAR(solution.multipliers[1], 0.1614685642, 1e-8);
}

TEST(Sqp, FindsIpoptsOptimaToEightDigits) {
  for (const std::string& name : paper_problem_names()) {
    for (const std::string& method : element_names()) {
      for (const Eigen::Index intervals : {16, 32, 64}) {
        SCOPED_TRACE(name + " " + method + " N = " + std::to_string(intervals));
        const auto problem = make_problem(name);
        const tests::Solved by_ipopt =
            tests::solve(*problem, {method, 1}, Grid::uniform(intervals), tests::common_start(*problem));
        Transcription program(*problem, *make_element(method), gauss_tableau(1), Grid::uniform(intervals));
        const Solution solution = solve_by_sqp(program, sample(program, tests::common_start(*problem)));
        EXPECT_EQ(solution.status, Status::solved) << solution.message;
        EXPECT_NEAR(solution.objective / by_ipopt.solution.objective, 1.0, 1e-10);
        EXPECT_LT((solution.primal - by_ipopt.solution.primal).lpNorm<Eigen::Infinity>(), 1e-6);
        const double largest = by_ipopt.solution.multipliers.lpNorm<Eigen::Infinity>();
        EXPECT_LT((solution.multipliers - by_ipopt.solution.multipliers).lpNorm<Eigen::Infinity>(), 1e-6 * largest);
      }
    }
  }
}

TEST(Sqp, SolvesWithActiveControlBoundsToAPointWhereIpoptStays) {
  const auto problem = make_problem("two_link_manipulator");
  for (const std::string& method : element_names()) {
    for (const double bound : {20.0, 16.0}) {
      SCOPED_TRACE(method + " " + std::to_string(bound));
      Transcription program(*problem, *make_element(method), gauss_tableau(1), Grid::uniform(32));
      auto bounded = sqp::tests::with_control_bound(program, bound);
      SolverOptions options;
      options.tolerance = 1e-8;
      const Solution solution = solve_by_sqp(bounded, sample(program, guessed_motion(*problem)), options);
      ASSERT_EQ(solution.status, Status::solved) << solution.message;
      const Solution by_ipopt = make_solver("ipopt")->solve(bounded, solution.primal);
      EXPECT_NEAR(by_ipopt.objective / solution.objective, 1.0, 1e-8);
      EXPECT_LT((by_ipopt.primal - solution.primal).lpNorm<Eigen::Infinity>(), 1e-3);  // Ipopt stays off its bounds
    }
  }
}

TEST(Sqp, KeepsFixedVariablesAtTheirValues) {
  tests::KnownProgram known = tests::hock_schittkowski().back();
  known.statement.variable_lower[1] = known.statement.variable_upper[1] = 4.5;
  SmallProgram program(known.statement);
  const Solution solution = solve_by_sqp(program, known.start);
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  EXPECT_EQ(solution.primal[1], 4.5);
}

TEST(Sqp, SaysInfeasibleWhereTheRowsCannotBeMet) {
  SmallProgram program = tests::equality_program(
      [](const HyperVector& x) { return x[0] * x[0] + x[1] * x[1]; },
      [](const HyperVector& x) { return HyperVector{x[0] * x[0] + x[1] * x[1]}; }, 2, vector({-1.0}));
  const Solution solution = solve_by_sqp(program, vector({1.0, 0.5}));
  EXPECT_EQ(solution.status, Status::infeasible) << solution.message;
  EXPECT_NEAR(solution.constraint_violation.value(), 1.0, 1e-3);
}

TEST(Sqp, GivesUpWithAWordWhereTheObjectiveFallsForever) {
  SmallProgram program =
      tests::equality_program([](const HyperVector& x) { return x[0]; },
                              [](const HyperVector&) { return HyperVector(); }, 1, Eigen::VectorXd(0));
  SolverOptions options;
  options.most_iterations = 100;
  const Solution solution = solve_by_sqp(program, vector({0.0}), options);
  EXPECT_FALSE(is_solved(solution.status));
  EXPECT_FALSE(solution.message.empty());
}

TEST(Sqp, StopsAtTheIterationLimitAndWhenAsked) {
  SmallProgram program = tests::rosenbrock();
  SolverOptions options;
  options.most_iterations = 3;
  const Solution limited = solve_by_sqp(program, vector({-1.2, 1.0}), options);
  EXPECT_EQ(limited.status, Status::iteration_limit);
  EXPECT_EQ(limited.major_iterations, 3);
  options.most_iterations = 500;
  int asked = 0;
  options.stop_requested = [&] { return ++asked > 4; };
  EXPECT_EQ(solve_by_sqp(program, vector({-1.2, 1.0}), options).status, Status::interrupted);
}

TEST(Sqp, SaysWhereAFormulaGivesNoNumber) {
  SmallProgram program =
      tests::equality_program([](const HyperVector& x) { return log(x[0]); },
                              [](const HyperVector&) { return HyperVector(); }, 1, Eigen::VectorXd(0));
  EXPECT_EQ(solve_by_sqp(program, vector({-1.0})).status, Status::evaluation_failed);
}

TEST(Sqp, StepsBackFromPlacesWhereAFormulaGivesNoNumber) {
  // x - log x has its minimum 1 at 1; the first full step from 3 leaves the domain.
  SmallProgram program =
      tests::equality_program([](const HyperVector& x) { return x[0] - log(x[0]); },
                              [](const HyperVector&) { return HyperVector(); }, 1, Eigen::VectorXd(0));
  const Solution solution = solve_by_sqp(program, vector({3.0}));
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  EXPECT_NEAR(solution.primal[0], 1.0, 1e-8);
}

TEST(Sqp, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(tests::sentence_of_error([] { SqpSolver(with("crush", "basis")); }),
            "the solver sqp has no option crush; it has crash, hessian, pricing and seed");
  EXPECT_EQ(tests::sentence_of_error([] { SqpSolver(with("crash", "all")); }),
            "the solver sqp: crash must be none or basis, not all");
  EXPECT_EQ(tests::sentence_of_error([] { SqpSolver(with("pricing", "steepest")); }),
            "the solver sqp: pricing must be largest, lowest, last or random, not steepest");
  EXPECT_EQ(tests::sentence_of_error([] { SqpSolver(with("seed", "1.5")); }),
            "the solver sqp: seed must be a whole number, not 1.5");
}

TEST(Sqp, RefusesAStartOfTheWrongSize) {
  SmallProgram program = tests::rosenbrock();
  EXPECT_EQ(tests::sentence_of_error([&] { static_cast<void>(solve_by_sqp(program, vector({1.0}))); }),
            "the start has 1 entries, the program 2 variables");
}

}  // namespace
}  // namespace dmocbench
