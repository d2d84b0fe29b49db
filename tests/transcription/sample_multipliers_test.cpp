#include "methods/transcription/sample_multipliers.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/container_crane.hpp"
#include "problems/two_link_manipulator.hpp"
#include "problems/two_link_with_motors.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;
using tests::Solved;

double largest_multiplier(const Eigen::VectorXd& multipliers) { return multipliers.lpNorm<Eigen::Infinity>(); }

double distance(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  return (one - other).lpNorm<Eigen::Infinity>();
}

/// Iterations of `interior_point` from a trajectory, with the multipliers that belong to it or without.
int iterations_from(const Trajectory& trajectory, Transcription& program, bool is_warm) {
  const Eigen::VectorXd start = sample(program, smooth_motion(trajectory));
  const Eigen::VectorXd multipliers = is_warm ? sample_multipliers(program, trajectory) : Eigen::VectorXd();
  const Solution solution = make_solver("interior_point")->solve(program, start, multipliers);
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  return solution.major_iterations.value();
}

/// A solve on a graded grid, whose multipliers are those sampled along its answer.
Trajectory expect_own(const Problem& problem, const Scheme& scheme, const Motion& start, double tolerance) {
  SCOPED_TRACE(problem.name() + " " + scheme.label());
  const Solved solved = tests::solve(problem, scheme, tests::graded_grid(16), start);
  const Eigen::VectorXd sampled = sample_multipliers(*solved.transcription, solved.trajectory);
  EXPECT_LT(distance(sampled, solved.solution.multipliers),
            tolerance * largest_multiplier(solved.solution.multipliers));
  return solved.trajectory;
}

TEST(SampleMultipliers, OfAProgramsOwnSolutionAreItsOwn) {
  for (const auto& problem : tests::problems()) {
    std::vector<Scheme> schemes = tests::all_schemes(3);
    schemes.push_back({"multiple_shooting_rk4_1", 2});
    for (const Scheme& scheme : schemes) expect_own(*problem, scheme, tests::common_start(*problem), 1e-10);
  }
}

TEST(SampleMultipliers, AreThoseOfTheCostSoFarInMayerForm) {
  const TwoLinkManipulator problem;
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    const Solved solved = tests::solve(problem, method, make_tableau("gauss", 2), Grid::uniform(16),
                                       tests::common_start(problem), 1e-10, CostForm::mayer);
    EXPECT_LT(distance(sample_multipliers(*solved.transcription, solved.trajectory), solved.solution.multipliers),
              1e-9 * largest_multiplier(solved.solution.multipliers));
  }
}

TEST(SampleMultipliers, OfFirstOrderStatesAreTheProgramsOwn) {
  const TwoLinkWithMotors problem;
  for (const Scheme& scheme : tests::all_schemes(3)) {
    expect_own(problem, scheme, tests::common_start(problem), 1e-9);
  }
}

TEST(SampleMultipliers, OfIntegralsAreTheirPrices) {
  const tests::DoubleIntegrator base;
  const tests::Restated problem(base, [](tests::Restated::Statement& s) {
    s.integrands = [](const ControlledState& x) { return ExpressionVector::Constant(1, x.q[0] * x.q[0]); };
    s.integrals = Bounds::all(1, 0.5, 0.5);
  });
  for (const Scheme& scheme : tests::all_schemes(3)) {
    const Trajectory motion = expect_own(problem, scheme, guessed_motion(problem), 1e-9);
    EXPECT_GT(std::abs(motion.integral_prices[0]), 1.0);
  }
}

// th:equi: one discrete optimum in two sets of unknowns, and so in two sets of multipliers.
TEST(SampleMultipliers, OfDmocAreThoseOfHamiltonianCollocationAndTheOtherWayRound) {
  const Grid grid = tests::graded_grid(16);
  for (const auto& problem : tests::problems()) {
    for (const int stages : {1, 2}) {
      SCOPED_TRACE(problem->name() + " " + std::to_string(stages));
      const Motion& start = tests::common_start(*problem);
      const Solved dmoc = tests::solve(*problem, Scheme{"dmoc", stages}, grid, start, 1e-11);
      const Solved hamiltonian = tests::solve(*problem, Scheme{"hamiltonian", stages}, grid, start, 1e-11);
      const auto expect_the_same = [](const Solved& from, const Solved& to) {
        EXPECT_LT(distance(sample_multipliers(*to.transcription, from.trajectory), to.solution.multipliers),
                  1e-6 * largest_multiplier(to.solution.multipliers));
      };
      expect_the_same(dmoc, hamiltonian);
      expect_the_same(hamiltonian, dmoc);
    }
  }
}

TEST(SampleMultipliers, OfACoarserGridApproachThoseOfAFinerWithOrderTwo) {
  const TwoLinkManipulator problem;
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    const Motion& start = tests::common_start(problem);
    const Solved fine = tests::solve(problem, Scheme{method}, Grid::uniform(256), start);
    const auto error_from = [&](Eigen::Index intervals) {
      const Solved coarse = tests::solve(problem, Scheme{method}, Grid::uniform(intervals), start);
      return distance(sample_multipliers(*fine.transcription, coarse.trajectory), fine.solution.multipliers);
    };
    EXPECT_GT(std::log2(error_from(32) / error_from(64)), 1.7);
  }
}

TEST(SampleMultipliers, LetASolveOnATwiceFinerGridOfAnotherMethodTakeAFewIterations) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    const Solved coarse = tests::solve(*problem, Scheme{"dmoc"}, Grid::uniform(32), tests::common_start(*problem));
    for (const Scheme& scheme : tests::all_schemes(2)) {
      SCOPED_TRACE(name + " " + scheme.label());
      const auto program = tests::transcribe(*problem, scheme, Grid::uniform(64));
      EXPECT_LE(iterations_from(coarse.trajectory, *program, true), 6);
    }
  }
}

TEST(SampleMultipliers, LetASolveWithBoundsOnTheControlsStartWarm) {
  const TwoLinkManipulator base;
  const Motion& start = tests::common_start(base);
  const double largest =
      tests::solve(base, Scheme{"dmoc"}, Grid::uniform(32), start).trajectory.stage_u.cwiseAbs().maxCoeff();
  const tests::Restated problem(base, [&](tests::Restated::Statement& statement) {
    statement.u = tests::all_between(2, -0.7 * largest, 0.7 * largest);
  });
  const Solved coarse = tests::solve(problem, Scheme{"dmoc"}, Grid::uniform(32), start);
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    const auto program = tests::transcribe(problem, Scheme{method}, Grid::uniform(64));
    const int warm = iterations_from(coarse.trajectory, *program, true);
    EXPECT_LT(warm, iterations_from(coarse.trajectory, *program, false));
    EXPECT_LE(warm, 12);
  }
}

// Multipliers of bounds on velocities, path constraints and boundary conditions, of which no costate tells.
TEST(SampleMultipliers, OfConstraintsWithoutCostatesBalanceTheGradient) {
  const tests::Everything everything;
  for (const Scheme& scheme : {Scheme{"dmoc"}, Scheme{"hamiltonian"}, Scheme{"tangent"}, Scheme{"dmoc", 2}}) {
    SCOPED_TRACE(scheme.label());
    const Solved solved =
        tests::solve(everything.problem(), scheme, Grid::uniform(32), guessed_motion(everything.problem()));
    const Eigen::VectorXd& own = solved.solution.multipliers;
    const Eigen::VectorXd sampled = sample_multipliers(*solved.transcription, solved.trajectory);
    EXPECT_LT(distance(sampled, own), 0.05 * largest_multiplier(own));
  }
}

TEST(SampleMultipliers, NeedCostates) {
  const tests::DoubleIntegrator problem;
  const auto program = tests::transcribe(problem, Scheme{"dmoc"}, Grid::uniform(8));
  const Trajectory without = read_trajectory(*program, sample(*program, guessed_motion(problem)), Eigen::VectorXd());
  EXPECT_THROW((void)sample_multipliers(*program, without), Error);
}

}  // namespace
}  // namespace dmocbench
