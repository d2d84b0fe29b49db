#include "methods/judgement/newton_correction.hpp"

#include <gtest/gtest.h>

#include "methods/judgement/confirm.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

/// min weight (x - 1)² + weight (y - 2)² with x + y = 3, bounded by y <= upper.
SmallProgram valley(double weight, double upper = unbounded) {
  SmallProgram::Statement statement;
  statement.objective = [weight](const HyperVector& x) {
    return weight * ((x[0] - 1.0) * (x[0] - 1.0) + (x[1] - 2.0) * (x[1] - 2.0));
  };
  statement.rows = [](const HyperVector& x) { return HyperVector{x[0] + x[1]}; };
  statement.variable_lower = vector({-unbounded, -unbounded});
  statement.variable_upper = vector({unbounded, upper});
  statement.row_lower = vector({3.0});
  statement.row_upper = vector({3.0});
  return SmallProgram(statement);
}

/// Residuals that are small enough, and a Newton step that is not.
Solution unsettled(SmallProgram& program) {
  Solution solution;
  solution.status = Status::solved;
  solution.primal = vector({1.1, 1.9});
  solution.multipliers = vector({0.0});
  confirm(program, 1e-10, solution);
  EXPECT_EQ(solution.status, Status::not_confirmed);
  return solution;
}

TEST(NewtonCorrection, IsTheWholeErrorWhereTheProgramIsQuadratic) {
  SmallProgram program = valley(1.0);
  const auto correction = tests::value_of(NewtonCorrections(program).at(vector({1.25, 1.75}), vector({0.5})));
  EXPECT_NEAR(correction.primal[0], -0.25, 1e-14);
  EXPECT_NEAR(correction.primal[1], 0.25, 1e-14);
  EXPECT_NEAR(correction.multipliers[0], -0.5, 1e-14);
  EXPECT_NEAR(correction.length, 0.25, 1e-12);  // 0.25 of a cost below 1; of x it is 0.25 / 1.75
}

TEST(NewtonCorrection, GoesToABoundThatTheGradientPressesAgainst) {
  SmallProgram program = valley(1.0, 1.5);  // optimum (1.5, 1.5), gradient (1, -1), λ = -1
  const auto correction = tests::value_of(NewtonCorrections(program).at(vector({1.501, 1.499}), vector({-1.002})));
  EXPECT_NEAR(correction.primal[1], 0.001, 1e-5);
  EXPECT_NEAR(correction.primal[0], -0.001, 1e-5);
}

TEST(NewtonCorrection, VanishesAtActiveBoundsAndInequalities) {
  for (const tests::KnownProgram& known : tests::hock_schittkowski()) {
    SCOPED_TRACE(known.number);
    SmallProgram program(known.statement);
    const Solution solution = make_solver("ipopt")->solve(program, known.start);
    ASSERT_EQ(solution.status, Status::solved);
    EXPECT_LT(solution.correction.value_or(0.0), 1e-6);
  }
}

TEST(NewtonCorrection, IsInfiniteWhereASecondDerivativeIsNotANumber) {
  SmallProgram program =
      tests::equality_program([](const HyperVector& x) { return pow(x[0], 1.5) + x[1] * x[1]; },
                              [](const HyperVector& x) { return HyperVector{x[0] + x[1]}; }, 2, vector({0.0}));
  const auto correction = tests::value_of(NewtonCorrections(program).at(vector({0.0, 0.0}), vector({0.0})));
  EXPECT_EQ(correction.length, unbounded);
}

/// The optimum is 0: all of what is left is error.
TEST(NewtonCorrection, IsNoShareOfUnknownsThatAreRounding) {
  SmallProgram program =
      tests::equality_program([](const HyperVector& x) { return x[0] * x[0] + x[1] * x[1]; },
                              [](const HyperVector& x) { return HyperVector{x[0] + x[1]}; }, 2, vector({0.0}));
  const auto length_at = [&](double size) {
    return tests::value_of(NewtonCorrections(program).at(vector({size, -size}), vector({0.0}))).length;
  };
  for (const double size : {1e-11, 1e-15, 1e-30}) EXPECT_LT(length_at(size), settled) << size;
  for (const double size : {1e-5, 1.0, 1e5}) EXPECT_GT(length_at(size), settled) << size;
}

TEST(NewtonCorrection, TakesSolvedBackFromAFlatProgramWhoseResidualsAreSmall) {
  SmallProgram program = valley(1e-10);
  Solution solution = unsettled(program);
  EXPECT_LT(tests::value_of(solution.kkt_residual), 1e-10);
  EXPECT_NE(solution.message.find("a Newton step would move the solution"), std::string::npos);

  EXPECT_EQ(settle(program, 1e-10, solution), 1);
  EXPECT_EQ(solution.status, Status::solved);
  EXPECT_NEAR(solution.primal[0], 1.0, 1e-12);
}

TEST(NewtonCorrection, SaysThatTheTimeWasUpWhereItEndedTheStepsThatSettle) {
  SmallProgram program = valley(1e-10);
  Solution solution = unsettled(program);
  const Eigen::VectorXd before = solution.primal;
  const StopScope scope({}, 1e-9);
  EXPECT_EQ(settle(program, 1e-10, solution), 0);
  EXPECT_EQ(solution.status, Status::time_limit) << solution.message;
  EXPECT_EQ(solution.primal, before);
}

TEST(NewtonCorrection, SaysThatItWasInterruptedWhereThatEndedTheStepsThatSettle) {
  SmallProgram program = valley(1e-10);
  Solution solution = unsettled(program);
  const StopScope scope([] { return true; }, 0.0);
  EXPECT_EQ(settle(program, 1e-10, solution), 0);
  EXPECT_EQ(solution.status, Status::interrupted) << solution.message;
}

/// Solved to residuals of 1e-10, the crane is wrong in the second digit of a control.
TEST(NewtonCorrection, SettlesTheCrane) {
  const auto problem = make_problem("container_crane");
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    const auto program = tests::transcribe(*problem, {method, 1}, Grid::uniform(256));
    Solution solution = make_solver("interior_point")->solve(*program, sample(*program, guessed_motion(*problem)));
    EXPECT_NE(solution.status, Status::solved);
    EXPECT_GE(settle(*program, 1e-10, solution), 1);
    EXPECT_EQ(solution.status, Status::solved) << solution.message;
    EXPECT_LE(solution.correction.value_or(unbounded), settled);
  }
}

/// The curvature along the first and last control of either arc is lost to rounding.
TEST(NewtonCorrection, IsNotHiddenByTheShiftOnASingularArc) {
  const auto problem = make_problem("refraction");
  const auto program = tests::transcribe(*problem, {"hamiltonian", 1}, Grid::uniform(1024));
  const Solution solution = make_solver("interior_point")->solve(*program, sample(*program, guessed_motion(*problem)));
  ASSERT_EQ(solution.status, Status::solved);
  const Eigen::VectorXd is_free =
      (program->variable_lower().array() < program->variable_upper().array()).cast<double>();
  const Eigen::VectorXd numbers = Eigen::VectorXd::LinSpaced(is_free.size(), 0.0, static_cast<double>(is_free.size()));
  for (const double distance : {0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-4}) {
    const Eigen::VectorXd moved = solution.primal.array() + distance * is_free.array() * numbers.array().square().sin();
    const auto is_settled = [&](NewtonCorrections::Factorisation factorisation) {
      return tests::value_of(NewtonCorrections(*program, factorisation).at(moved, solution.multipliers)).length <=
             settled;
    };
    EXPECT_EQ(is_settled(NewtonCorrections::Factorisation::by_intervals),
              is_settled(NewtonCorrections::Factorisation::sparse))
        << distance;
  }
}

}  // namespace
}  // namespace dmocbench
