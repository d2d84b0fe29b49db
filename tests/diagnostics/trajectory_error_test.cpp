#include "methods/diagnostics/trajectory_error.hpp"

#include <gtest/gtest.h>

#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

/// q = (t², 3t), u = 2 - 5t sampled: the two-stage polynomials contain all of it.
Trajectory parabola(Eigen::Index intervals) {
  Trajectory trajectory;
  trajectory.tableau = gauss_tableau(2);
  trajectory.node_times = Eigen::VectorXd::LinSpaced(intervals + 1, 0.0, 1.0);
  const Eigen::ArrayXd t = trajectory.node_times.array();
  trajectory.q.resize(intervals + 1, 2);
  trajectory.q << t * t, 3.0 * t;
  trajectory.v.resize(intervals + 1, 2);
  trajectory.v << 2.0 * t, Eigen::ArrayXd::Constant(intervals + 1, 3.0);
  trajectory.p = trajectory.v;
  trajectory.stage_times.resize(2 * intervals);
  for (Eigen::Index k = 0; k < intervals; ++k) {
    trajectory.stage_times.segment(2 * k, 2) =
        (static_cast<double>(k) + trajectory.tableau.c.array()) / static_cast<double>(intervals);
  }
  const Eigen::ArrayXd s = trajectory.stage_times.array();
  trajectory.stage_v.resize(2 * intervals, 2);
  trajectory.stage_v << 2.0 * s, Eigen::ArrayXd::Constant(2 * intervals, 3.0);
  trajectory.stage_u = (2.0 - 5.0 * s).matrix();
  trajectory.cost = 1.0;
  return trajectory;
}

TEST(TrajectoryError, IsZeroAgainstItself) {
  const auto problem = make_problem("two_link_manipulator");
  for (const tests::Scheme& scheme : tests::all_schemes(2)) {
    const Trajectory trajectory =
        tests::solve(*problem, scheme, tests::graded_grid(24), tests::common_start(*problem)).trajectory;
    const TrajectoryError error = trajectory_error(trajectory, trajectory);
    EXPECT_EQ(error.state, 0.0);
    EXPECT_EQ(error.momentum, 0.0);
    EXPECT_LT(error.control, 1e-10);  // through the polynomial of controls of size 100
    EXPECT_EQ(error.costate, 0.0);
    EXPECT_EQ(error.objective, 0.0);
  }
}

TEST(TrajectoryError, MeasuresEachQuantityByItself) {
  const Trajectory reference = parabola(6);
  Trajectory moved = reference;
  moved.q(3, 0) += 0.3;
  moved.q(3, 1) -= 0.4;
  moved.p(2, 1) += 0.25;
  moved.stage_u(7, 0) -= 0.125;
  moved.cost = 1.5;
  const TrajectoryError error = trajectory_error(moved, reference);
  EXPECT_NEAR(error.state, 0.5, 1e-14);
  EXPECT_NEAR(error.momentum, 0.25, 1e-14);
  EXPECT_NEAR(error.control, 0.125, 1e-13);
  EXPECT_EQ(error.objective, 0.5);
  EXPECT_FALSE(error.costate.has_value());
}

TEST(TrajectoryError, ComparesCostatesAsOneVectorPerNode) {
  Trajectory reference = parabola(4);
  reference.psi_q = reference.q;
  reference.psi_p = reference.p;
  Trajectory moved = reference;
  moved.psi_q(1, 0) += 3.0;
  moved.psi_p(1, 1) += 4.0;
  EXPECT_NEAR(tests::value_of(trajectory_error(moved, reference).costate), 5.0, 1e-13);
}

TEST(TrajectoryError, ComparesStagesOnlyWithStagesAtTheSameTimes) {
  const auto problem = make_problem("two_link_manipulator");
  const Motion& start = tests::common_start(*problem);
  const Trajectory solved = tests::solve(*problem, {"dmoc", 2}, Grid::uniform(24), start).trajectory;
  Trajectory moved = solved;
  moved.stage_q(3, 1) += 0.5;
  moved.stage_p(4, 0) -= 0.25;
  moved.stage_psi_q(5, 1) += 2.0;
  moved.stage_psi_p(6, 0) -= 3.0;
  const auto error = tests::value_of(trajectory_error(moved, solved).stages);
  EXPECT_NEAR(error.configuration, 0.5, 1e-14);
  EXPECT_NEAR(error.momentum, 0.25, 1e-12);
  EXPECT_NEAR(error.costate_q.value_or(0.0), 2.0, 1e-12);
  EXPECT_NEAR(error.costate_p.value_or(0.0), 3.0, 1e-12);
  const Trajectory finer = tests::solve(*problem, {"dmoc", 2}, Grid::uniform(48), start).trajectory;
  EXPECT_FALSE(trajectory_error(solved, finer).stages.has_value());
}

TEST(TrajectoryError, TakesTheReferencesPolynomialWhereNodesDoNotMeet) {
  // 7 and 10 intervals share only the ends; the polynomials are exact, so nothing is left.
  const TrajectoryError error = trajectory_error(parabola(7), parabola(10));
  EXPECT_LT(error.state, 1e-14);
  EXPECT_LT(error.control, 1e-13);
  EXPECT_LT(error.momentum, 1e-14);
}

TEST(TrajectoryError, FindsNodesThatCoincideUpToRounding) {
  // k/49 and (3k)/147 differ in their last bits; momenta exist at nodes only, so missing one would hide the defect.
  const Trajectory coarse = parabola(49);
  for (Eigen::Index k = 0; k <= 49; ++k) {
    Trajectory moved = coarse;
    moved.p(k, 0) += 1.0;
    EXPECT_NEAR(trajectory_error(moved, parabola(147)).momentum, 1.0, 1e-13) << k;
  }
}

}  // namespace
}  // namespace dmocbench
