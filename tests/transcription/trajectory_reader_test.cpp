#include "methods/transcription/trajectory_reader.hpp"

#include <numbers>

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

/// A mass in a plane that is pushed with a given force into the direction of an angle.
class Steered final : public tests::SmallProblem {
 public:
  Steered(bool is_angle, bool is_bounded)
      : SmallProblem("steered", BoundaryState::at_rest(Eigen::Vector2d::Zero()),
                     BoundaryState::at_rest(Eigen::Vector2d::Ones()), 1.0, 1),
        is_angle_(is_angle),
        is_bounded_(is_bounded) {}
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{cos(x.u[0]), sin(x.u[0])}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return is_angle_ ? Expression(0.0) : x.u[0] * x.u[0];
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    if (is_bounded_) bounds.u = Bounds::all(1, -10.0, 10.0);
    return bounds;
  }

 private:
  bool is_angle_;
  bool is_bounded_;
};

TEST(Trajectory, HasNoWholeTurnsBetweenStagesOfAFreeControlThatIsAnAngle) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const Eigen::VectorXd turns = Eigen::VectorXd{{0.0, 1.0, -1.0, 2.0, 2.0, 0.0, -3.0, 1.0}};
  const Eigen::VectorXd smooth = Eigen::VectorXd::LinSpaced(8, 0.1, 1.5);
  const auto read = [&](const Problem& problem) {
    const auto program = tests::transcribe(problem, {"dmoc", 2}, Grid::uniform(4));
    Eigen::VectorXd primal = sample(*program, guessed_motion(problem));
    for (Eigen::Index i = 0; i < 8; ++i) {
      primal[program->blocks().unknown(Quantity::control, i % 2).index() + i / 2] = smooth[i] + turn * turns[i];
    }
    return read_trajectory(*program, primal, {});
  };
  EXPECT_LT((read(Steered(true, false)).stage_u - smooth).norm(), 1e-12);
  const Eigen::VectorXd as_they_are = smooth + turn * turns;
  EXPECT_EQ(read(Steered(false, false)).stage_u, as_they_are);  // its size is paid for
  EXPECT_EQ(read(Steered(true, true)).stage_u, as_they_are);
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
