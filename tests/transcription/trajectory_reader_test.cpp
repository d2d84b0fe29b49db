#include "methods/transcription/trajectory_reader.hpp"

#include <gtest/gtest.h>

#include "methods/mechanics/legendre_transform.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::problems;
using tests::Scheme;
using tests::Solved;

TEST(Trajectory, MomentumIsTheSameSeenFromBothSidesOfANode) {
  for (const auto& problem : problems()) {
    for (const Scheme& scheme : tests::all_schemes()) {
      const Solved solved =
          tests::solve(*problem, scheme, tests::graded_grid(24), tests::common_start(*problem), 1e-11);
      Transcription& program = *solved.transcription;
      const Eigen::MatrixXd sides = program.tabulate(program.functions().momenta, solved.solution.primal);
      const Eigen::Index n = problem->configuration_size();
      const Eigen::Index inner = sides.rows() - 1;
      const Eigen::MatrixXd jump = sides.topRightCorner(inner, n) - sides.bottomLeftCorner(inner, n);
      EXPECT_LT(jump.lpNorm<Eigen::Infinity>(), 1e-9) << problem->name() << ", " << scheme.label();
    }
  }
}

TEST(Trajectory, EndsInThePrescribedConfigurationsVelocitiesAndMomenta) {
  for (const auto& problem : problems()) {
    LegendreTransform legendre{TracedProblem(*problem)};
    const BoundaryState first = problem->initial_state();
    const BoundaryState last = problem->final_state();
    const Eigen::VectorXd p0 = legendre.momentum(first.q, first.v, 0.0);
    const Eigen::VectorXd pT = legendre.momentum(last.q, last.v, problem->horizon());
    for (const Scheme& scheme : tests::all_schemes()) {
      SCOPED_TRACE(problem->name() + ", " + scheme.label());
      const Trajectory trajectory =
          tests::solve(*problem, scheme, tests::graded_grid(24), tests::common_start(*problem), 1e-11).trajectory;
      const Eigen::Index end = trajectory.intervals();
      EXPECT_EQ(trajectory.q.row(0).transpose(), first.q);
      EXPECT_EQ(trajectory.q.row(end).transpose(), last.q);
      EXPECT_LT((trajectory.p.row(0).transpose() - p0).norm(), 1e-9);
      EXPECT_LT((trajectory.p.row(end).transpose() - pT).norm(), 1e-9);
      EXPECT_LT((trajectory.v.row(0).transpose() - first.v).norm(), 1e-8);
      EXPECT_LT((trajectory.v.row(end).transpose() - last.v).norm(), 1e-8);
    }
  }
}

TEST(Trajectory, VelocitiesSolveTheLegendreTransformAtEveryNode) {
  for (const auto& problem : problems()) {
    LegendreTransform legendre{TracedProblem(*problem)};
    for (const Scheme& scheme : tests::all_schemes(2)) {
      const Trajectory trajectory =
          tests::solve(*problem, scheme, Grid::uniform(24), tests::common_start(*problem)).trajectory;
      for (Eigen::Index k = 0; k <= trajectory.intervals(); ++k) {
        const Eigen::VectorXd p = legendre.momentum(trajectory.q.row(k).transpose(), trajectory.v.row(k).transpose(),
                                                    trajectory.node_times[k]);
        EXPECT_LT((p - trajectory.p.row(k).transpose()).norm(), 1e-12 * (1.0 + p.norm()))
            << problem->name() << ", " << scheme.label();
      }
    }
  }
}

TEST(Trajectory, StageTimesAreNodesPlusStageFractionsOfTheStep) {
  const auto problem = make_problem("orbital_transfer");
  for (const Scheme& scheme : tests::all_schemes()) {
    const auto program = tests::transcribe(*problem, scheme, tests::graded_grid(7));
    const Eigen::VectorXd x = sample(*program, guessed_motion(*problem));
    const Trajectory trajectory = read_trajectory(*program, x, Eigen::VectorXd());
    ASSERT_EQ(trajectory.stage_times.size(), 7 * scheme.stages);
    for (Eigen::Index row = 0; row < trajectory.stage_times.size(); ++row) {
      const Eigen::Index k = row / scheme.stages;
      const double expected =
          trajectory.node_times[k] + program->tableau().c[row % scheme.stages] * program->steps(x)[k];
      EXPECT_NEAR(trajectory.stage_times[row], expected, 1e-14);
    }
  }
}

TEST(Trajectory, CostIsTheTrueOneNotTheScaledOne) {
  // J of design: 3.945000e-5 at N = 64; its scale is 1e4.
  const auto problem = make_problem("orbital_transfer");
  const Solved solved = tests::solve(*problem, {"dmoc", 1}, Grid::uniform(64), guessed_motion(*problem));
  EXPECT_NEAR(solved.trajectory.cost, 3.945000102e-5, 1e-13);
  EXPECT_NEAR(solved.solution.objective, 1e4 * solved.trajectory.cost, 1e-12);
}

TEST(Trajectory, OfTheTwoLinkArmHasTheKnownOptimalCosts) {
  const auto problem = make_problem("two_link_manipulator");
  for (const char* method : {"dmoc", "hamiltonian"}) {
    const Trajectory trajectory =
        tests::solve(*problem, {method, 1}, Grid::uniform(64), tests::common_start(*problem)).trajectory;
    EXPECT_NEAR(trajectory.cost, 80.47711423, 5e-9) << method;
  }
}

TEST(Trajectory, RefusesVectorsOfTheWrongSize) {
  const tests::DoubleIntegrator problem;
  const auto program = tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(8));
  tests::expect_error_naming({std::to_string(program->variable_count()), "3"}, [&] {
    static_cast<void>(read_trajectory(*program, Eigen::VectorXd::Zero(3), Eigen::VectorXd()));
  });
}

}  // namespace
}  // namespace dmocbench
